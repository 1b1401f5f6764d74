//! Takes requests on the loopback address until it is told to stop.

use std::{
    io,
    net::{Ipv4Addr, SocketAddr, TcpListener},
    path::Path,
    sync::{Arc, LazyLock, mpsc},
    thread,
    time::Instant,
};

use analysis::GearCache;
use live::{Machine, Session};
use tokio::{runtime, sync::Notify};

use crate::{guard::Guard, listen, queue::Queue, routes::Routes, workers::Workers};

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
    #[error("no server on {address}: {source}")]
    Start {
        /// Where it was to be.
        address: SocketAddr,
        /// What the system says.
        source: io::Error,
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
    listener: TcpListener,
    address: SocketAddr,
    guard: Guard,
    stop: Arc<Notify>,
}

impl std::fmt::Debug for Server {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Server").field("at", &self.address).finish_non_exhaustive()
    }
}

/// Time since it was first asked for, ms.
fn clock_ms() -> f64 {
    static FIRST: LazyLock<Instant> = LazyLock::new(Instant::now);
    1e3 * FIRST.elapsed().as_secs_f64()
}

/// Ends a server, from any thread.
#[derive(Debug, Clone)]
pub struct Stop(Arc<Notify>);

impl Stop {
    /// No further request is taken, and solves end at their next step.
    pub fn stop(&self) {
        self.0.notify_one();
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
        listener.set_nonblocking(true).map_err(|source| ServeError::Start { address, source })?;
        Ok(Self { listener, address, guard: Guard::new(address.port()), stop: Arc::default() })
    }

    /// The address of the page, which holds the token.
    pub fn address(&self) -> String {
        self.guard.address()
    }

    /// Where it listens.
    pub fn local_address(&self) -> SocketAddr {
        self.address
    }

    /// What ends it.
    pub fn stop_handle(&self) -> Stop {
        Stop(Arc::clone(&self.stop))
    }

    /// Serves the page of a scene's text until it is stopped; `file` is what messages name and what paths are relative
    /// to. Reduced gears come from `cache` and go there; `free_bytes` says how much memory is free. Nothing that a client sends ends it.
    ///
    /// # Errors
    /// [`ServeError::Start`] when the system gives no means to wait for requests.
    pub fn run(
        self,
        text: &str,
        file: &Path,
        free_bytes: fn() -> f64,
        cache: &dyn GearCache,
    ) -> Result<(), ServeError> {
        let Self { listener, address, guard, stop } = self;
        let start = |source| ServeError::Start { address, source };
        let runtime = runtime::Builder::new_current_thread().enable_io().enable_time().build().map_err(start)?;
        let listener = {
            let _inside = runtime.enter();
            tokio::net::TcpListener::from_std(listener).map_err(start)?
        };
        let (queue, (work, jobs)) = (Arc::new(Queue::default()), mpsc::channel());
        let session = Session::new(text, file, Machine { free_bytes, clock_ms }, cache);
        let workers = Workers::new(&session, &queue);
        thread::scope(|scope| {
            let workers = &workers;
            let helper = |name: &str| thread::Builder::new().name(name.into());
            helper("warm").spawn_scoped(scope, || workers.warm()).map_err(start)?;
            helper("work").spawn_scoped(scope, move || workers.work(scope, jobs)).map_err(start)?;
            let routes = Routes::new(guard, (text.to_owned(), file.to_owned()), Arc::clone(&queue), work);
            runtime.block_on(listen::serve(listener, Arc::new(routes), &stop));
            queue.end();
            // With the last connection the last that could give work.
            drop(runtime);
            Ok(())
        })
    }
}
