//! What the counted operations cost a simulated processor.

use desim::Duration;
use multicomputer::Machine;
use radiosity::{Operation, Work};

use crate::on::error::RunError;

/// What each operation costs a processor, seconds.
pub(super) struct Prices([f64; Operation::ALL.len()]);

impl Prices {
    pub fn of(machine: &Machine) -> Result<Prices, RunError> {
        let mut prices = [0.0; Operation::ALL.len()];
        for (price, &operation) in prices.iter_mut().zip(Operation::ALL) {
            let (part, name) = ("processor has no price", operation.name());
            let seconds = machine.processor.price(name);
            *price = seconds.ok_or(RunError::Missing { part, name, unit: "cycles" })?;
        }
        Ok(Prices(prices))
    }

    pub fn time(&self, work: &Work) -> Duration {
        let costs = work.counts().zip(&self.0).map(|((_, times), price)| times as f64 * price);
        Duration::from_seconds_f64(costs.sum())
    }
}
