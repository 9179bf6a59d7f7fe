//! A process: a named future that only events resume.

use std::future::Future;
use std::pin::Pin;

/// The body of a process.
pub(crate) type Body = Pin<Box<dyn Future<Output = ()>>>;

pub(crate) struct Process {
    pub(crate) name: String,
    /// `None` while the process runs, and once it has ended.
    pub(crate) body: Option<Body>,
}
