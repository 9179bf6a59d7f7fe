//! Dense symmetric matrices, and conjugate gradients for the radiosity system.
//!
//! No linear-algebra crate is used: the scaled system is symmetric and positive definite, ten to fifty
//! products with the matrix solve it to machine precision, and the error bound is specific to this problem. A
//! factorisation would take n³/3 operations for each colour, and such a crate much of the build time.

/// A symmetric matrix with zeros on its diagonal.
pub(crate) struct Symmetric {
    n: usize,
    /// Row by row.
    entries: Vec<f64>,
}

impl Symmetric {
    /// The matrix whose rows left of the diagonal are given.
    pub(crate) fn new(rows: Vec<Vec<f64>>) -> Symmetric {
        let n = rows.len();
        let mut entries = vec![0.0; n * n];
        for (i, row) in rows.into_iter().enumerate() {
            for (j, entry) in row.into_iter().enumerate() {
                entries[i * n + j] = entry;
                entries[j * n + i] = entry;
            }
        }
        Symmetric { n, entries }
    }

    pub(crate) fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.n + j]
    }

    /// The product with a vector.
    pub(crate) fn times(&self, vector: &[f64]) -> Vec<f64> {
        self.entries.chunks(self.n.max(1)).map(|row| dot(row, vector)).collect()
    }
}

/// The irradiances H with A H = g + G (ρ H), and a bound of the error of each; infinite if
/// rounding leaves no bound. A: areas; G: areas times form factors; ρ: reflectances.
///
/// The rows times ρ make the symmetric system (A ρ − ρ G ρ) H = ρ g, positive definite where ρ is not
/// zero. A last gathering step gives H where ρ is zero, and bounds the error elsewhere.
pub(crate) fn solve(
    exchange: &Symmetric,
    areas: &[f64],
    reflectance: &[f64],
    gathered: &[f64],
) -> (Vec<f64>, f64) {
    let gather = |h: &[f64]| -> Vec<f64> {
        let brought = exchange.times(&product(reflectance, h));
        let sum = brought.iter().zip(gathered).map(|(brought, given)| brought + given);
        sum.zip(areas).map(|(sum, &area)| if area > 0.0 { sum / area } else { 0.0 }).collect()
    };
    let diagonal = product(areas, reflectance);
    let apply = |p: &[f64]| -> Vec<f64> {
        let reflected = product(reflectance, &exchange.times(&product(reflectance, p)));
        product(&diagonal, p).iter().zip(reflected).map(|(own, other)| own - other).collect()
    };
    let start = gather(&vec![0.0; areas.len()]);
    let h = conjugate_gradients(apply, &diagonal, &product(reflectance, gathered), start);
    let better = gather(&h);
    // The contraction factor of a gathering step.
    let rows = exchange.times(reflectance);
    let rows = rows.iter().zip(areas).filter(|&(_, &area)| area > 0.0);
    let contraction = rows.map(|(sum, area)| sum / area).fold(0.0, f64::max);
    let lit = |&i: &usize| reflectance[i] > 0.0;
    let change = (0..areas.len()).filter(lit).map(|i| (better[i] - h[i]).abs()).fold(0.0, f64::max);
    let bound =
        if contraction < 1.0 { change * contraction / (1.0 - contraction) } else { f64::INFINITY };
    (better, bound)
}

/// Solves `apply(x) = right` with `x` as first guess, preconditioned by the diagonal, until rounding stops
/// progress (Hestenes and Stiefel 1952). Where the diagonal is zero, so is the whole row.
fn conjugate_gradients(
    apply: impl Fn(&[f64]) -> Vec<f64>,
    diagonal: &[f64],
    right: &[f64],
    mut x: Vec<f64>,
) -> Vec<f64> {
    let scaled = |r: &[f64]| -> Vec<f64> {
        r.iter().zip(diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect()
    };
    let goal = f64::EPSILON * f64::EPSILON * dot(right, &scaled(right));
    let mut r: Vec<f64> = right.iter().zip(apply(&x)).map(|(right, left)| right - left).collect();
    let mut z = scaled(&r);
    let mut p = z.clone();
    let mut size = dot(&r, &z);
    for _ in 0..10 * x.len() {
        if size <= goal {
            break;
        }
        let ap = apply(&p);
        let step = size / dot(&p, &ap);
        if !step.is_finite() {
            break;
        }
        add(&mut x, step, &p);
        add(&mut r, -step, &ap);
        z = scaled(&r);
        let next = dot(&r, &z);
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + next / size * *p);
        size = next;
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Eight independent sums, for vector instructions.
    let mut sums = [0.0; 8];
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a8.remainder().iter().zip(b8.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a8.zip(b8) {
        (0..8).for_each(|i| sums[i] += a[i] * b[i]);
    }
    sums.iter().sum::<f64>() + rest
}

fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

fn add(x: &mut [f64], factor: f64, p: &[f64]) {
    x.iter_mut().zip(p).for_each(|(x, p)| *x += factor * p);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ten patches that see each other equally, one of them black: repeated gathering gives the same
    /// solution, up to a reflectance of 0.999.
    #[test]
    fn repeated_gathering_gives_the_same_solution() {
        let areas: Vec<f64> = (1..=10).map(f64::from).collect();
        let rows = (0..10).map(|i| (0..i).map(|j| areas[i] * areas[j] / 60.0).collect()).collect();
        let exchange = Symmetric::new(rows);
        let gathered: Vec<f64> = (0..10).map(|i| f64::from(i % 3)).collect();
        for rho in [0.0, 0.5, 0.999] {
            let mut reflectance = vec![rho; 10];
            reflectance[3] = 0.0;
            let (h, bound) = solve(&exchange, &areas, &reflectance, &gathered);
            let mut plain = vec![0.0; 10];
            for _ in 0..20_000 {
                let brought = exchange.times(&product(&reflectance, &plain));
                plain = (0..10).map(|i| (gathered[i] + brought[i]) / areas[i]).collect();
            }
            assert!(bound < 1e-10, "{rho}: {bound}");
            for (h, plain) in h.iter().zip(&plain) {
                assert!((h - plain).abs() <= 1e-12 * plain, "{rho}: {h} {plain}");
            }
        }
    }
}
