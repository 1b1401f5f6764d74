//! Nobody but the page itself is answered, and it loads nothing from elsewhere.

use std::net::{IpAddr, TcpStream, UdpSocket};
use std::time::Duration;

use crate::served::{ISO, Served};

#[test]
fn who_lacks_the_token_is_refused() {
    let served = Served::new(ISO);
    let token = served.path.trim_matches('/').to_owned();
    assert!(token.len() == 32 && token.bytes().all(|b| b.is_ascii_hexdigit()), "{token}");
    let other = if token.starts_with('0') { "1" } else { "0" }.to_owned() + &token[1..];
    let paths = [
        "/",
        "//",
        "/page.js",
        "/solve",
        &format!("/{other}/"),
        &format!("/{}/", &token[..31]),
        &format!("/{token}"),
        &format!("/{token}0/"),
    ]
    .map(str::to_owned);
    for path in paths {
        let reply = served.get(&path);
        assert_eq!(reply.status, 403, "{path}");
        assert!(!reply.body.contains(&token) && !reply.head.contains(&token), "{path}: the token is told");
        assert!(reply.body.contains("`ale-gear serve` has printed the whole address"), "{path}: {}", reply.body);
    }
    assert_eq!(served.get(&served.path).status, 200);
    assert_ne!(Served::new(ISO).path, served.path, "two runs share a token");
}

/// A page of somebody else whose name leads to 127.0.0.1 (DNS rebinding) says that name.
#[test]
fn another_name_of_this_machine_is_refused() {
    let served = Served::new(ISO);
    let port = served.address.port();
    let as_host =
        |lines: &str| served.raw(&format!("GET {} HTTP/1.1\r\n{lines}Connection: close\r\n\r\n", served.path)).status;
    for name in ["evil.example", "127.0.0.1.evil.example", "0.0.0.0", "[::1]", "127.0.0.2"] {
        assert_eq!(as_host(&format!("Host: {name}:{port}\r\n")), 403, "{name}");
    }
    assert_eq!(as_host("Host: 127.0.0.1\r\n"), 403, "another port");
    assert_eq!(as_host(&format!("Host: 127.0.0.1:{port}\r\nHost: evil.example\r\n")), 403, "two names");
    assert_eq!(as_host(""), 403, "no name");
    assert_eq!(as_host(&format!("Host: localhost:{port}\r\n")), 200);
}

#[test]
fn a_page_of_another_address_is_refused() {
    let served = Served::new(ISO);
    let from = |origin: &str| {
        let (path, host) = (&served.path, served.address);
        let lines = format!("Host: {host}\r\nOrigin: {origin}\r\nContent-Length: 2\r\nConnection: close");
        served.raw(&format!("POST {path}solve HTTP/1.1\r\n{lines}\r\n\r\n{{}}")).status
    };
    assert_eq!(from("http://evil.example"), 403);
    assert_eq!(from("null"), 403);
    assert_eq!(from(&format!("https://{}", served.address)), 403);
    assert_eq!(from(&format!("http://{}", served.address)), 400, "its own page: the move alone is wrong");
}

/// Not by the address that this machine has for others, where it has one.
#[test]
fn no_address_but_loopback_is_bound() {
    let served = Served::new(ISO);
    assert!(served.address.ip().is_loopback(), "{}", served.address);
    // No packet is sent: connecting a datagram socket only looks up the way.
    let own = UdpSocket::bind("0.0.0.0:0").and_then(|s| s.connect("192.0.2.1:9").and_then(|()| s.local_addr()));
    if let Some(ip) = own.ok().map(|a| a.ip()).filter(|ip: &IpAddr| !ip.is_loopback() && !ip.is_unspecified()) {
        let outside = TcpStream::connect_timeout(&(ip, served.address.port()).into(), Duration::from_secs(2));
        assert!(outside.is_err(), "{ip} answers");
    }
}

#[test]
fn every_answer_keeps_the_page_to_itself() {
    let served = Served::new(ISO);
    let path = |name: &str| format!("{}{name}", served.path);
    for name in ["", "style.css", "charts.js", "view.js", "page.js", "nothing"] {
        let reply = served.get(&path(name));
        assert_eq!(reply.status, if name == "nothing" { 404 } else { 200 }, "{name}");
        for line in [
            "Content-Security-Policy: default-src 'none';",
            "frame-ancestors 'none'",
            "Referrer-Policy: no-referrer",
            "nosniff",
        ] {
            assert!(reply.head.contains(line), "{name}: no `{line}` in\n{}", reply.head);
        }
        let policy = reply.head.lines().find(|line| line.starts_with("Content-Security-Policy")).unwrap();
        assert!(!policy.contains("unsafe") && !policy.contains("http") && !policy.contains('*'), "{name}: {policy}");
    }
    let html = served.get(&served.path).body;
    for foreign in ["src=\"http", "href=\"http", "src=\"//", "<script>", " style=\"", "onclick="] {
        assert!(!html.contains(foreign), "the page has `{foreign}`");
    }
    assert!(served.get("/").head.contains("Content-Security-Policy"), "a refusal too");
}

#[test]
fn what_is_no_move_is_told_so() {
    let served = Served::new(ISO);
    assert_eq!(served.get(&format!("{}solve", served.path)).status, 405);
    let page = served.open();
    for (body, status, words) in [
        ("{", 400, "not readable"),
        ("[]", 400, "not readable"),
        (&format!("{{\"page\": {}, \"number\": 1, \"text\": \"\"}}", page + 7), 400, "was not opened by this server"),
        (&"x".repeat((1 << 20) + 2), 413, "more than 1048576 bytes"),
    ] {
        let reply = served.post(body);
        assert_eq!(reply.status, status, "{}", reply.body);
        assert!(reply.body.contains(words), "{}", reply.body);
    }
}

#[test]
fn a_server_that_is_stopped_ends_and_is_gone() {
    let mut served = Served::new(ISO);
    let page = served.open();
    assert_eq!(served.moved(page, 1, ISO, serde_json::json!({})).status, 200);
    served.end();
    // The listening thread takes a moment to go. Another test's server may have got the port by then: it does not know
    // the token.
    let gone = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        TcpStream::connect(served.address).is_err()
    });
    assert!(gone || served.get(&served.path).status == 403, "it still listens");
}
