//! Whatever a client sends, the server lives, holds little of it, and answers others meanwhile.

use std::{
    io::{Read, Write},
    net::TcpStream,
    thread,
};

use serde_json::json;

use crate::served::{ISO, Served, with_contact};

/// Bytes of a stranger that a server may have taken before it closes, with those that the system holds on the way.
const TAKEN: usize = 16 << 20;

fn connected(served: &Served, begin: &str) -> TcpStream {
    let mut stream = TcpStream::connect(served.address).unwrap();
    stream.write_all(begin.as_bytes()).unwrap();
    stream
}

/// Writes the same piece until the server does not take it; how many bytes it has taken, at the most `limit`.
fn pour(stream: &mut TcpStream, piece: &[u8], limit: usize) -> usize {
    let mut taken = 0;
    while taken < limit {
        match stream.write(piece) {
            Ok(0) | Err(_) => break,
            Ok(bytes) => taken += bytes,
        }
    }
    taken
}

fn answers(served: &Served) {
    assert_eq!(served.get(&served.path).status, 200, "the server has ended");
}

/// A length is what the client says: nothing is made of it, and no body is read of who lacks the token.
#[test]
fn a_length_is_only_a_word() {
    let served = Served::new(ISO);
    let (host, path) = (served.address, &served.path);
    for length in ["1000000000000", "9223372036854775807"] {
        let lines = format!("Host: {host}\r\nContent-Length: {length}\r\n\r\nabc");
        assert_eq!(served.raw(&format!("GET /no-token HTTP/1.1\r\n{lines}")).status, 403);
        assert_eq!(served.raw(&format!("POST {path}solve HTTP/1.1\r\n{lines}")).status, 413);
    }
    for (wrong, status) in [("-1", 400), ("99999999999999999999999", 400), ("x", 400), ("18446744073709551615", 431)] {
        let lines = format!("Host: {host}\r\nContent-Length: {wrong}\r\n\r\nabc");
        assert_eq!(served.raw(&format!("POST {path}solve HTTP/1.1\r\n{lines}")).status, status, "{wrong}");
    }
    answers(&served);
}

/// Neither a line nor a number of lines without an end is kept, nor a body in pieces that goes on for ever.
#[test]
fn what_does_not_end_is_not_kept() {
    let served = Served::new(ISO);
    let (host, path) = (served.address, &served.path);
    let line = vec![b'a'; 1 << 16];
    let chunk = [b"10000\r\n", &line[..], b"\r\n"].concat();
    let chunked = format!("POST {path}solve HTTP/1.1\r\nHost: {host}\r\nTransfer-Encoding: chunked\r\n\r\n");
    let stranger = chunked.replace(path.as_str(), "/no-token/");
    for (begin, piece) in [
        ("GET / HTTP/1.1\r\nX: ".to_owned(), &line[..]),
        ("GET / HTTP/1.1\r\n".to_owned(), b"X: 1\r\n"),
        ("GET /".to_owned(), &line),
        (String::new(), &line),
        (chunked.clone(), &chunk),
        (stranger, &chunk),
        (format!("{chunked}1;x="), &line),
        (format!("{chunked}0\r\n"), b"X: 1\r\n"),
    ] {
        let mut stream = connected(&served, &begin);
        let taken = pour(&mut stream, piece, 4 * TAKEN);
        assert!(taken < TAKEN, "{taken} bytes were taken behind {begin:?}");
        answers(&served);
    }
}

/// Who says nothing, or little, keeps no place from others.
#[test]
fn silent_connections_make_room() {
    let served = Served::new(ISO);
    let (host, path) = (served.address, &served.path);
    let mut silent: Vec<TcpStream> = Vec::new();
    for i in 0..300 {
        silent.push(connected(&served, if i % 2 == 0 { "GET / HT" } else { "" }));
        if i % 50 == 49 {
            answers(&served);
        }
    }
    // Those that were here longest have made room.
    let mut end = Vec::new();
    let _ = silent[0].read_to_end(&mut end);
    assert!(end.is_empty(), "{end:?}");
    // Requests with the token that never send their body.
    let half = format!("POST {path}solve HTTP/1.1\r\nHost: {host}\r\nContent-Length: 100\r\n\r\n{{");
    let waiting: Vec<TcpStream> = (0..40).map(|_| connected(&served, &half)).collect();
    answers(&served);
    drop((silent, waiting));
    answers(&served);
}

/// Keys, texts and moves nested without end are complaints.
#[test]
fn nested_input_is_told() {
    let served = Served::new(ISO);
    let deep = |n: usize| vec!["a"; n].join(".");
    for parts in [9, 5_000, 100_000] {
        let answer = served.answer(ISO, json!({ deep(parts): "1" }));
        assert!(answer["fault"]["message"].as_str().unwrap().contains(&format!("{parts} parts")), "{answer}");
    }
    let nested = |open: &str, close: &str, n: usize| format!("{}1{}", open.repeat(n), close.repeat(n));
    for text in [
        format!("{} = 1\n{ISO}", deep(100_000)),
        format!("{ISO}\n[{}]\n", deep(100_000)),
        format!("{ISO}\n[[{}]]\n", deep(100_000)),
        format!("name = {}\n{ISO}", nested("[", "]", 200_000)),
        format!("name = {}\n{ISO}", nested("{a=", "}", 100_000)),
    ] {
        let answer = served.answer(&text, json!({}));
        assert!(answer["fault"]["message"].is_string(), "{answer}");
    }
    for value in [nested("[", "]", 200_000), nested("{a=", "}", 100_000)] {
        let answer = served.answer(ISO, json!({ "operation.torque_nm": value }));
        assert!(answer["fault"]["message"].is_string(), "{answer}");
    }
    for body in [nested("[", "]", 400_000), nested("{\"set\":", "}", 100_000)] {
        assert_eq!(served.post(&body).status, 400);
    }
    answers(&served);
}

/// The pair on gears that take many seconds to reduce.
fn with_wide_gears() -> String {
    let text =
        with_contact().replace("order = 1", "order = 2").replace("elements_profile = 2", "elements_profile = 14");
    text.replace("elements_face = 2", "elements_face = 32")
}

/// A reduction that takes long keeps nothing from another page, and the next move of its own page ends it.
#[test]
fn a_long_reduction_is_given_up_and_blocks_nobody() {
    let served = Served::new(&with_contact());
    let (page, other) = (served.open(), served.open());
    let (light, wide) = (with_contact(), with_wide_gears());
    thread::scope(|scope| {
        let served = &served;
        let long = scope.spawn(move || served.moved(page, 1, &wide, json!({})).status);
        assert_eq!(served.moved(other, 1, &light, json!({})).status, 200);
        assert!(!long.is_finished(), "the other page was answered behind the reduction");
        assert_eq!(served.moved(page, 2, &light, json!({ "operation.torque_nm": "140" })).status, 200);
        assert_eq!(long.join().unwrap(), 409, "a later move has come");
    });
}

/// Whoever asked has gone: nobody waits for the answer, and the server does not either.
#[test]
fn who_leaves_takes_the_work_along() {
    let mut served = Served::new(&with_contact());
    let (page, wide) = (served.open(), with_wide_gears());
    let body = json!({ "page": page, "number": 1, "text": wide, "set": {} }).to_string();
    let (host, path, length) = (served.address, served.path.clone(), body.len());
    let head = format!("POST {path}solve HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n");
    drop(connected(&served, &(head + &body)));
    answers(&served);
    served.end();
}
