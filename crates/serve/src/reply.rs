//! Answers, each with the headers that keep the page to itself.

use std::io::Cursor;

use tiny_http::{Header, Response, StatusCode};

/// An answer in memory.
pub(crate) type Reply = Response<Cursor<Vec<u8>>>;

/// Sent with every answer. Nothing is loaded from elsewhere, no other page may frame it or read it, and its address,
/// which holds the token, goes nowhere.
const HEADERS: [(&str, &str); 6] = [
    (
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
         base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cross-Origin-Opener-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
];

/// An answer of a status and kind.
pub(crate) fn reply(status: u16, kind: &str, body: impl Into<Vec<u8>>) -> Reply {
    let all = HEADERS.into_iter().chain([("Content-Type", kind)]);
    let headers = all.filter_map(|(name, value)| Header::from_bytes(name, value).ok()).collect();
    let body = body.into();
    let length = body.len();
    // In one piece, whose length is known.
    Response::new(StatusCode(status), headers, Cursor::new(body), Some(length), None).with_chunked_threshold(usize::MAX)
}

/// A line of text for who reads it.
pub(crate) fn says(status: u16, line: &str) -> Reply {
    reply(status, "text/plain; charset=utf-8", format!("{line}\n"))
}

/// Data for the page.
pub(crate) fn json(status: u16, body: impl Into<Vec<u8>>) -> Reply {
    reply(status, "application/json", body)
}
