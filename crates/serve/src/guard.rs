//! Who may ask: who knows the token, by an address of this machine itself, from the page itself.

use hyper::{HeaderMap, Uri, header};

/// What a request must show.
#[derive(Debug)]
pub(crate) struct Guard {
    token: String,
    hosts: [String; 2],
}

/// Why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(crate) enum Refusal {
    /// Another name than this machine's own: a page of somebody else who has let a name of theirs lead here.
    #[error("this server answers to 127.0.0.1 and localhost alone")]
    Host,
    /// A page of another address asks.
    #[error("this server answers its own page alone")]
    Origin,
    /// The address is not the one that was told.
    #[error("the address lacks the token of this run; `ale-gear serve` has printed the whole address")]
    Token,
}

impl Guard {
    /// With a token of its own for a port.
    pub fn new(port: u16) -> Self {
        let token = format!("{:032x}", rand::random::<u128>());
        Self { token, hosts: ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}")) }
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.hosts[0], self.token)
    }

    /// What follows the token in the address of a request that may be answered. Nothing but the head of the request is
    /// looked at.
    pub fn admit<'a>(&self, uri: &'a Uri, headers: &HeaderMap) -> Result<&'a str, Refusal> {
        let header = |name| {
            let mut all = headers.get_all(name).iter();
            // What is no text is no name of ours.
            (all.next().map(|value| value.to_str().unwrap_or_default()), all.next().is_some())
        };
        let (host, twice) = header(header::HOST);
        let own = |host: &str| self.hosts.iter().any(|own| host.eq_ignore_ascii_case(own));
        if twice || !host.is_some_and(own) || uri.authority().is_some_and(|host| !own(host.as_str())) {
            return Err(Refusal::Host);
        }
        let own = |origin: &str| self.hosts.iter().any(|host| origin == format!("http://{host}"));
        match header(header::ORIGIN) {
            (_, true) => return Err(Refusal::Origin),
            (Some(origin), false) if !own(origin) => return Err(Refusal::Origin),
            _ => {}
        }
        let (token, rest) = uri.path().strip_prefix('/').and_then(|path| path.split_once('/')).unwrap_or_default();
        // Hashes are compared in a time that does not depend on how much of them is alike.
        if blake3::hash(token.as_bytes()) != blake3::hash(self.token.as_bytes()) {
            return Err(Refusal::Token);
        }
        Ok(rest)
    }
}
