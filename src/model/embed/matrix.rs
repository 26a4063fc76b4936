//! Rows of numbers: the little linear algebra that a transformer needs.
//!
//! Sums are taken in a fixed order of eight lanes, so that the result is the same everywhere and
//! the compiler can use its vector instructions.

/// A matrix, one row after the other.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Matrix {
    pub columns: usize,
    pub values: Vec<f32>,
}

impl Matrix {
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { columns, values: vec![0.0; rows * columns] }
    }

    pub fn rows(&self) -> std::slice::ChunksExact<'_, f32> {
        self.values.chunks_exact(self.columns)
    }

    pub fn row(&self, n: usize) -> &[f32] {
        &self.values[n * self.columns..(n + 1) * self.columns]
    }

    pub fn row_mut(&mut self, n: usize) -> &mut [f32] {
        &mut self.values[n * self.columns..(n + 1) * self.columns]
    }

    pub fn n_rows(&self) -> usize {
        self.values.len() / self.columns
    }

    pub fn add(&mut self, other: &Self) {
        self.values.iter_mut().zip(&other.values).for_each(|(a, b)| *a += b);
    }
}

/// Σ aᵢbᵢ.
pub(super) fn dot(a: &[f32], b: &[f32]) -> f32 {
    const LANES: usize = 8;
    let mut sums = [0.0_f32; LANES];
    let (a_chunks, b_chunks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f32 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_chunks.zip(b_chunks) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum::<f32>() + rest
}

/// A linear layer: y = W x + b for each row x, W stored one output after the other.
#[derive(Clone, Debug)]
pub(super) struct Linear {
    pub weight: Matrix,
    pub bias: Vec<f32>,
}

impl Linear {
    pub fn apply(&self, input: &Matrix) -> Matrix {
        let mut output = Matrix::zeros(input.n_rows(), self.bias.len());
        // Each row of the weights is fetched once, however many tokens there are.
        for (n, (weights, bias)) in self.weight.rows().zip(&self.bias).enumerate() {
            for (row, x) in input.rows().enumerate() {
                output.values[row * self.bias.len() + n] = dot(weights, x) + bias;
            }
        }
        output
    }
}

/// Layer normalisation of each row: (x − μ)/√(σ² + ε) · w + b (Ba, Kiros, Hinton, 2016,
/// arXiv:1607.06450).
#[derive(Clone, Debug)]
pub(super) struct Norm {
    pub weight: Vec<f32>,
    pub bias: Vec<f32>,
    pub epsilon: f32,
}

impl Norm {
    pub fn apply(&self, matrix: &mut Matrix) {
        let count = matrix.columns as f32;
        for row in matrix.values.chunks_exact_mut(matrix.columns) {
            let mean = row.iter().sum::<f32>() / count;
            let variance = row.iter().map(|x| (x - mean) * (x - mean)).sum::<f32>() / count;
            let scale = 1.0 / (variance + self.epsilon).sqrt();
            for ((x, weight), bias) in row.iter_mut().zip(&self.weight).zip(&self.bias) {
                *x = (*x - mean) * scale * weight + bias;
            }
        }
    }
}

/// Makes a row of scores one of weights that add up to 1.
pub(super) fn softmax(row: &mut [f32]) {
    let largest = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    row.iter_mut().for_each(|x| *x = libm::expf(*x - largest));
    let sum: f32 = row.iter().sum();
    row.iter_mut().for_each(|x| *x /= sum);
}

/// x · Φ(x), Φ the normal distribution (Hendrycks and Gimpel, 2016, arXiv:1606.08415).
pub(super) fn gelu(x: f32) -> f32 {
    0.5 * x * (1.0 + libm::erff(x * std::f32::consts::FRAC_1_SQRT_2))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f32, b: f32) -> bool {
        (a - b).abs() < 1e-6
    }

    #[test]
    fn a_product_is_the_sum_of_products() {
        let a: Vec<f32> = (0..19).map(|n| n as f32).collect();
        assert!(near(dot(&a, &a), 2109.0));
        let layer = Linear {
            weight: Matrix { columns: 2, values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0] },
            bias: vec![0.5, 0.0, -1.0],
        };
        let out = layer.apply(&Matrix { columns: 2, values: vec![1.0, 1.0, 0.0, -1.0] });
        assert_eq!(out.values, [3.5, 7.0, 10.0, -1.5, -4.0, -7.0]);
    }

    #[test]
    fn rows_are_normalised() {
        let norm = Norm { weight: vec![2.0; 4], bias: vec![1.0; 4], epsilon: 0.0 };
        let mut matrix = Matrix { columns: 4, values: vec![1.0, 1.0, 3.0, 3.0] };
        norm.apply(&mut matrix);
        assert_eq!(matrix.values, [-1.0, -1.0, 3.0, 3.0]);
    }

    #[test]
    fn the_functions_have_their_known_values() {
        let mut row = [0.0, std::f32::consts::LN_2];
        softmax(&mut row);
        assert!(near(row[0], 1.0 / 3.0) && near(row[1], 2.0 / 3.0));
        // Φ(1) = 0.841345.
        assert!(near(gelu(1.0), 0.841_345) && near(gelu(0.0), 0.0));
    }
}
