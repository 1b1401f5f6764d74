//! Takes connections and answers their requests.

use std::{
    convert::Infallible,
    future::{Future, poll_fn},
    pin::pin,
    sync::Arc,
    task::Poll,
    time::Duration,
};

use hyper::{Request, body::Incoming, server::conn::http1, service::service_fn};
use hyper_util::rt::TokioIo;
use tokio::{
    net::{TcpListener, TcpStream},
    sync::Notify,
    time::{sleep_until, timeout},
};

use crate::{
    routes::Routes,
    visit::{Connections, Visit},
};

/// Bytes of the head of a request; a browser sends about one of these sixteen kilobytes.
const MOST_OF_HEAD: usize = 16 << 10;
/// Where the system gives no further connection, it is asked again after this time.
const PAUSE: Duration = Duration::from_millis(50);

/// Takes connections until it is told to stop. No error of the system and nothing that a client does ends it.
pub(crate) async fn serve(listener: TcpListener, routes: Arc<Routes>, stop: &Notify) {
    let connections = Arc::new(Connections::default());
    let mut stopped = pin!(stop.notified());
    loop {
        let next = {
            let mut accepted = pin!(listener.accept());
            poll_fn(|cx| match stopped.as_mut().poll(cx) {
                Poll::Ready(()) => Poll::Ready(None),
                Poll::Pending => accepted.as_mut().poll(cx).map(Some),
            })
            .await
        };
        match next {
            None => break,
            // Too many open files, or whoever came has gone already.
            Some(Err(_)) => {
                if timeout(PAUSE, &mut stopped).await.is_ok() {
                    break;
                }
            }
            Some(Ok((stream, _))) => {
                connections.welcome(|visit| tokio::spawn(attend(stream, visit, Arc::clone(&routes))).abort_handle())
            }
        }
        // Those that were closed give their files back.
        tokio::task::yield_now().await;
    }
}

/// Answers the one request of a connection, within its time.
async fn attend(stream: TcpStream, visit: Arc<Visit>, routes: Arc<Routes>) {
    let answer = service_fn(|request: Request<Incoming>| {
        let (routes, visit) = (Arc::clone(&routes), Arc::clone(&visit));
        async move { Ok::<_, Infallible>(routes.reply(request, &visit).await) }
    });
    let mut http = http1::Builder::new();
    http.keep_alive(false).max_buf_size(MOST_OF_HEAD).header_read_timeout(None).title_case_headers(true);
    let mut connection = pin!(http.serve_connection(TokioIo::new(stream), answer));
    let mut alarm = pin!(sleep_until(visit.until()));
    poll_fn(|cx| {
        if connection.as_mut().poll(cx).is_ready() {
            return Poll::Ready(());
        }
        let until = visit.until();
        if alarm.deadline() != until {
            alarm.as_mut().reset(until);
        }
        alarm.as_mut().poll(cx)
    })
    .await;
}
