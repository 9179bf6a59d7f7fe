//! The programs on threads of this host, with channels: a reference for the simulation.

mod process;

use std::future::Future;
use std::pin::pin;
use std::sync::mpsc::channel;
use std::task::{Context, Poll, Waker};
use std::thread::ScopedJoinHandle;
use std::time::Instant;

use desim::{Duration, Time};
use radiosity::Work;

use self::process::ThreadProcess;
use super::error::RunError;
use super::host::{balanced, total};
use super::prepared::Prepared;
use crate::program::{NoDisplay, NodeResult, ProgramError, compute_node, service_node};
use crate::run::{Counts, NodeReport, Outcome, Run};

/// Carries out a run on threads of this host, one for each processor and one for the service node. The time
/// of the outcome is host time. The light is that of the simulation, except for effects of message order.
///
/// # Errors
/// Why the run could not be made, or did not end.
pub fn run_on_threads(run: &Run) -> Result<Outcome, RunError> {
    let Prepared { nodes, collection, host } = Prepared::new(run)?;
    let (to, from): (Vec<_>, Vec<_>) = (0..=nodes.len()).map(|_| channel()).unzip();
    #[expect(clippy::disallowed_methods, reason = "on threads time is the host's")]
    let start = Instant::now();
    let processes = from.into_iter().enumerate();
    let process = |(rank, from)| ThreadProcess::new(rank, to.clone(), from, start, host.clone());
    let mut processes: Vec<ThreadProcess> = processes.map(process).collect();
    let service = processes.pop().expect("there is one more process than compute nodes");
    let mut programs: Vec<Program> = vec![Box::new(move || {
        carry_out(&service, service_node(&service, &NoDisplay, collection))?;
        Ok((None, service.meter.read()))
    })];
    for (process, node) in processes.into_iter().zip(nodes) {
        programs.push(Box::new(move || {
            let result = carry_out(&process, compute_node(&process, node))?;
            Ok((Some(result), process.meter.read()))
        }));
    }
    let ended = on_threads(programs, || to.iter().for_each(process::end))?;
    let time = Time::ZERO + Duration::from_seconds_f64(start.elapsed().as_secs_f64());
    let (results, counted): (Vec<_>, Vec<_>) = ended.into_iter().unzip();
    let reports = vec![NodeReport::default(); run.processors];
    let results = results.into_iter().flatten().collect();
    balanced(Outcome::of(run, time, results, total(counted), reports))
}

/// What a compute node found, and what was counted.
type Found = (Option<NodeResult>, (Counts, Work));

/// A program to be carried out.
type Program = Box<dyn FnOnce() -> Result<Found, RunError> + Send>;

/// Carry out programs, each on a thread of its own, and wait for all. If a thread cannot be started, `end` ends
/// those that were.
fn on_threads(programs: Vec<Program>, end: impl Fn()) -> Result<Vec<Found>, RunError> {
    let all = programs.len();
    std::thread::scope(|scope| {
        let start = |program| std::thread::Builder::new().spawn_scoped(scope, program);
        let (threads, failed): (Vec<_>, Vec<_>) =
            programs.into_iter().map(start).partition(Result::is_ok);
        if !failed.is_empty() {
            end();
        }
        // All are joined, also after one that failed.
        let join = |thread: ScopedJoinHandle<'_, _>| thread.join().unwrap_or(Err(RunError::Thread));
        let ended: Vec<_> = threads.into_iter().flatten().map(join).collect();
        match failed.into_iter().find_map(Result::err) {
            Some(cause) => Err(RunError::NoThread { threads: all, cause: cause.to_string() }),
            None => ended.into_iter().collect(),
        }
    })
}

/// Carry out a program whose waits block its thread: it is done at the first poll.
fn carry_out<T>(
    process: &ThreadProcess,
    program: impl Future<Output = Result<T, ProgramError>>,
) -> Result<T, RunError> {
    match pin!(program).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(result) => Ok(result.inspect_err(|_| process.end_all())?),
        Poll::Pending => Err(RunError::Thread),
    }
}
