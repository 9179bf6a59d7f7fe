//! Space cut into local environments, and their owners (§3.4, §4.2.1).

use radiosity::{Block, Side};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The number of a process: compute nodes from 0, then service nodes.
pub type Rank = usize;

/// Space cut into a box of local environments, numbered with x running fastest.
///
/// Choice C2: RR-3008 calls its decomposition straightforward and leaves its shape open. Here planes
/// cut the grid of cells into equal parts along each axis, rounded to whole cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decomposition {
    cells: [u32; 3],
    cut: [u32; 3],
}

impl Decomposition {
    /// Cut a grid of `cells` into `cut` environments along each axis; 1 ≤ cut ≤ cells.
    pub fn new(cells: [u32; 3], cut: [u32; 3]) -> Decomposition {
        Decomposition { cells, cut }
    }

    /// Number of environments.
    pub fn environments(&self) -> u32 {
        self.cut.iter().product()
    }

    /// The cells of an environment.
    pub fn block(&self, environment: u32) -> Block {
        let [x, y, _] = self.cut;
        let at = [environment % x, environment / x % y, environment / (x * y)];
        let plane = |axis: usize, i: u32| {
            (u64::from(self.cells[axis]) * u64::from(i) / u64::from(self.cut[axis])) as u32
        };
        Block {
            low: std::array::from_fn(|axis| plane(axis, at[axis])),
            high: std::array::from_fn(|axis| plane(axis, at[axis] + 1)),
        }
    }

    /// The environment behind a side of another, which must have one there.
    pub fn neighbour(&self, environment: u32, side: Side) -> u32 {
        let stride: u32 = self.cut[..side.axis].iter().product();
        if side.upper { environment + stride } else { environment - stride }
    }
}

/// Which processor gets which environments.
///
/// Choice C3: RR-3008 leaves it open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Mapping {
    /// Equal contiguous runs of environment numbers.
    #[default]
    Blocks,
    /// Environment i goes to processor i modulo their number.
    Cyclic,
    /// Equal shares, shuffled by the seed.
    Random,
}

impl Mapping {
    /// The processor of each environment; the seed matters for a random mapping only. Every processor gets
    /// one if there are no more processors than environments.
    pub fn owners(self, environments: u32, processors: usize, seed: u64) -> Vec<Rank> {
        let n = environments as usize;
        let mut owners: Vec<Rank> = match self {
            Mapping::Cyclic => (0..n).map(|i| i % processors).collect(),
            Mapping::Blocks | Mapping::Random => (0..n).map(|i| i * processors / n).collect(),
        };
        if self == Mapping::Random {
            owners.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
        }
        owners
    }
}
