//! Takes requests on the loopback address until it is told to stop.

use std::{
    io,
    net::{Ipv4Addr, SocketAddr, TcpListener},
    sync::{
        Arc, Weak,
        atomic::{AtomicBool, Ordering},
    },
    thread,
};

use analysis::GearCache;

use crate::{
    desk::{Desk, Limits},
    guard::Guard,
    routes::{Routes, answer},
};

/// Why no page can be served.
#[derive(Debug, thiserror::Error)]
pub enum ServeError {
    /// The port cannot be had.
    #[error("port {port} of 127.0.0.1 cannot be had: {source}")]
    Port {
        /// As asked for.
        port: u16,
        /// What the system says.
        source: io::Error,
    },
    /// The server does not start.
    #[error("no server on {address}: {reason}")]
    Start {
        /// Where it was to be.
        address: SocketAddr,
        /// What happened.
        reason: String,
    },
}

impl ServeError {
    /// What to do next.
    pub fn hint(&self) -> String {
        match self {
            Self::Port { port: 0, .. } | Self::Start { .. } => "does the system allow listening on 127.0.0.1?".into(),
            Self::Port { .. } => "leave `--port` out: a free one is taken".into(),
        }
    }
}

/// A page that is served on this machine alone.
pub struct Server {
    http: Arc<tiny_http::Server>,
    stopped: Arc<AtomicBool>,
    guard: Guard,
}

impl std::fmt::Debug for Server {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Server").field("at", &self.local_address()).finish_non_exhaustive()
    }
}

/// Ends a server, from any thread.
#[derive(Clone)]
pub struct Stop {
    /// The port is free as soon as the server is dropped.
    http: Weak<tiny_http::Server>,
    stopped: Arc<AtomicBool>,
}

impl std::fmt::Debug for Stop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stop").finish_non_exhaustive()
    }
}

impl Stop {
    /// No further request is taken, and solves end at their next position.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::SeqCst);
        if let Some(http) = self.http.upgrade() {
            http.unblock();
        }
    }
}

impl Server {
    /// Binds a port of 127.0.0.1, any free one for 0.
    ///
    /// # Errors
    /// [`ServeError`] when the system refuses.
    pub fn bind(port: u16) -> Result<Self, ServeError> {
        let refused = |source| ServeError::Port { port, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(refused)?;
        let address = listener.local_addr().map_err(refused)?;
        let http = tiny_http::Server::from_listener(listener, None)
            .map_err(|e| ServeError::Start { address, reason: e.to_string() })?;
        let guard = Guard::new(address.port());
        Ok(Self { http: Arc::new(http), stopped: Arc::default(), guard })
    }

    /// The address of the page, which holds the token.
    pub fn address(&self) -> String {
        self.guard.address()
    }

    /// Where it listens; `None` only where the system has no such thing.
    pub fn local_address(&self) -> Option<SocketAddr> {
        self.http.server_addr().to_ip()
    }

    /// What ends it.
    pub fn stop_handle(&self) -> Stop {
        Stop { http: Arc::downgrade(&self.http), stopped: Arc::clone(&self.stopped) }
    }

    /// Serves the page of a scene's text until it is stopped; `file` is what messages name and what paths are relative
    /// to. Reduced gears come from `cache` and go there.
    pub fn run(&self, text: &str, file: &std::path::Path, limits: Limits, cache: &dyn GearCache) {
        let desk = Desk::new(text, file, limits, cache);
        let routes = Routes::new(&self.guard, &desk);
        thread::scope(|scope| {
            // The gears are reduced while the browser opens.
            scope.spawn(|| desk.warm(&|| !self.stopped.load(Ordering::SeqCst)));
            while let Ok(request) = self.http.recv() {
                if self.stopped.load(Ordering::SeqCst) {
                    break;
                }
                let routes = &routes;
                scope.spawn(move || answer(routes, request));
            }
            self.stopped.store(true, Ordering::SeqCst);
            routes.end();
        });
    }
}
