//! A server in this process, and requests to it byte by byte.

use std::{
    io::{Read, Write},
    net::{SocketAddr, TcpStream},
    path::Path,
    thread::JoinHandle,
};

use analysis::NoCache;
use serde_json::{Value, json};
use serve::{Server, Stop};

/// A pair without meshes: solved at once.
pub const ISO: &str = "[pinion]\nteeth = 30\nhelix_angle_deg = 20.0\n[wheel]\nteeth = 30\n[pair]\nnormal_module_mm = 3.0\n\
    face_width_mm = 20.0\n[operation]\ntorque_nm = 150.0 # on the wheel\n[analysis]\nmodel = \"iso\"\n";

/// The pair with contact, on the smallest meshes.
pub fn with_contact() -> String {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let text = ISO.replace("model = \"iso\"", "positions_per_cycle = 6");
    text.replace("teeth = 30\n", &format!("teeth = 30\n{mesher}"))
}

/// A server that ends with the value.
pub struct Served {
    pub address: SocketAddr,
    /// Path of the page, with the token.
    pub path: String,
    stop: Stop,
    thread: Option<JoinHandle<()>>,
}

/// What was answered.
pub struct Reply {
    pub status: u16,
    pub head: String,
    pub body: String,
}

impl Served {
    pub fn new(text: &str) -> Self {
        let server = Server::bind(0).unwrap();
        let address = server.local_address();
        let path = server.address().split_once(&address.to_string()).unwrap().1.to_owned();
        let (stop, text) = (server.stop_handle(), text.to_owned());
        let thread = std::thread::spawn(move || server.run(&text, Path::new("a.toml"), || 1e12, &NoCache).unwrap());
        Self { address, path, stop, thread: Some(thread) }
    }

    /// A request as it is written; `Connection: close` must be in it.
    pub fn raw(&self, request: &str) -> Reply {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut all = Vec::new();
        // A server that refuses a body closes before it has come.
        let _ = stream.read_to_end(&mut all);
        let all = String::from_utf8(all).unwrap();
        let (head, body) = all.split_once("\r\n\r\n").unwrap_or_else(|| panic!("no answer to {request}: {all}"));
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        Reply { status, head: head.to_owned(), body: body.to_owned() }
    }

    /// A request of the page's own.
    pub fn get(&self, path: &str) -> Reply {
        self.raw(&format!("GET {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", self.address))
    }

    pub fn post(&self, body: &str) -> Reply {
        let (path, host, length) = (&self.path, self.address, body.len());
        self.raw(&format!(
            "POST {path}solve HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        ))
    }

    /// Opens a page; its number.
    pub fn open(&self) -> u64 {
        let html = self.get(&self.path).body;
        let (_, rest) = html.split_once("data-page=\"").unwrap_or_else(|| panic!("no page: {html}"));
        rest.split('"').next().unwrap().parse().unwrap()
    }

    /// A move of a page.
    pub fn moved(&self, page: u64, number: u64, text: &str, set: Value) -> Reply {
        self.post(&json!({ "page": page, "number": number, "text": text, "set": set }).to_string())
    }

    /// The answer to the only move of a new page.
    pub fn answer(&self, text: &str, set: Value) -> Value {
        let reply = self.moved(self.open(), 1, text, set);
        assert_eq!(reply.status, 200, "{}", reply.body);
        serde_json::from_str(&reply.body).unwrap()
    }

    /// Ends it, and waits for that.
    pub fn end(&mut self) {
        self.stop.stop();
        if let Some(thread) = self.thread.take() {
            thread.join().unwrap();
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            self.end();
        }
    }
}
