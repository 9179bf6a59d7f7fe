//! The programs on threads of this host, with channels: a reference for the simulation.

mod process;

use std::future::Future;
use std::pin::pin;
use std::sync::mpsc::channel;
use std::task::{Context, Poll, Waker};
use std::time::Instant;

use desim::{Duration, Time};

use self::process::ThreadProcess;
use super::error::RunError;
use super::host::total;
use super::prepared::Prepared;
use crate::program::{NoDisplay, Unreadable, compute_node, service_node};
use crate::run::{NodeReport, Outcome, Run};

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
    drop(to);
    let service = processes.pop().expect("there is one more process than compute nodes");
    let (finished, served) = std::thread::scope(|scope| {
        let service = scope
            .spawn(move || carry_out(&service, service_node(&service, &NoDisplay, collection)));
        let compute = |(process, node)| {
            scope.spawn(move || {
                let result = carry_out(&process, compute_node(&process, node))?;
                Ok((result, process.meter.read()))
            })
        };
        let threads: Vec<_> = processes.into_iter().zip(nodes).map(compute).collect();
        // All are joined, also after one that failed.
        let joined =
            threads.into_iter().map(|thread| thread.join().unwrap_or(Err(RunError::Thread)));
        (joined.collect::<Vec<_>>(), service.join().unwrap_or(Err(RunError::Thread)))
    });
    served?;
    let finished: Vec<_> = finished.into_iter().collect::<Result<_, _>>()?;
    let time = Time::ZERO + Duration::from_seconds_f64(start.elapsed().as_secs_f64());
    let (results, counts): (Vec<_>, Vec<_>) = finished.into_iter().unzip();
    let reports = vec![NodeReport::default(); results.len()];
    Ok(Outcome::of(run, time, results, total(counts), reports))
}

/// Carry out a program whose waits block its thread: it is done at the first poll.
fn carry_out<T>(
    process: &ThreadProcess,
    program: impl Future<Output = Result<T, Unreadable>>,
) -> Result<T, RunError> {
    match pin!(program).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(result) => Ok(result.inspect_err(|_| process.end_all())?),
        Poll::Pending => Err(RunError::Thread),
    }
}
