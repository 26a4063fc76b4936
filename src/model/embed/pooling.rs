//! From the states of the tokens to one vector.

use std::path::Path;

use super::matrix::Matrix;
use super::{EmbedError, json};

/// How the states of the tokens become one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pooling {
    /// Their mean.
    Mean,
    /// The state of the first one.
    First,
}

impl Pooling {
    /// As `1_Pooling/config.json` says; the mean if there is none.
    pub fn load(folder: &Path) -> Result<Self, EmbedError> {
        let path = folder.join("1_Pooling").join("config.json");
        let Some(config) = json(&path)? else { return Ok(Self::Mean) };
        let asks = |mode: &str| config.get(mode).and_then(serde_json::Value::as_bool) == Some(true);
        let modes = ["pooling_mode_mean_tokens", "pooling_mode_cls_token"].map(asks);
        let others = ["pooling_mode_max_tokens", "pooling_mode_mean_sqrt_len_tokens"].map(asks);
        match (modes, others) {
            ([true, false], [false, false]) => Ok(Self::Mean),
            ([false, true], [false, false]) => Ok(Self::First),
            _ => Err(EmbedError::new(&path, "neither the mean nor the first token is asked for")),
        }
    }

    pub fn pool(self, states: &Matrix) -> Vec<f32> {
        if self == Self::First {
            return states.row(0).to_vec();
        }
        let mut sum = vec![0.0; states.columns];
        for row in states.rows() {
            sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
        }
        let count = states.n_rows() as f32;
        sum.iter_mut().for_each(|x| *x /= count);
        sum
    }
}
