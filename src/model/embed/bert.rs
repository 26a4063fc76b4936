//! The BERT encoder (Devlin et al., 2019, arXiv:1810.04805; attention: Vaswani et al., 2017,
//! arXiv:1706.03762), for one text at a time and without padding.

use std::path::Path;

use serde::Deserialize;

use super::matrix::{Linear, Matrix, Norm, dot, gelu, softmax};
use super::tensors::Tensors;
use super::{EmbedError, json};

/// `config.json`, what of it counts.
#[derive(Deserialize)]
struct Config {
    model_type: String,
    hidden_size: usize,
    num_hidden_layers: usize,
    num_attention_heads: usize,
    intermediate_size: usize,
    hidden_act: String,
    layer_norm_eps: f32,
    #[serde(default)]
    position_embedding_type: Option<String>,
}

/// Larger ones are not for this.
const MAX_LAYERS: usize = 48;

/// A BERT encoder.
pub(super) struct Bert {
    words: Matrix,
    positions: Matrix,
    kinds: Matrix,
    norm: Norm,
    layers: Vec<Layer>,
}

struct Layer {
    heads: usize,
    query: Linear,
    key: Linear,
    value: Linear,
    mix: Linear,
    mix_norm: Norm,
    widen: Linear,
    narrow: Linear,
    norm: Norm,
}

impl Bert {
    pub fn load(folder: &Path) -> Result<Self, EmbedError> {
        let config = config(&folder.join("config.json"))?;
        let path = folder.join("model.safetensors");
        let tensors = Tensors::open(&path)?;
        let (size, epsilon) = (config.hidden_size, config.layer_norm_eps);
        let table = |name: &str| {
            tensors.matrix(&format!("embeddings.{name}_embeddings.weight"), None, size)
        };
        let layers = (0..config.num_hidden_layers).map(|n| Layer::load(&tensors, &config, n));
        Ok(Self {
            words: table("word")?,
            positions: table("position")?,
            kinds: table("token_type")?,
            norm: tensors.norm("embeddings.LayerNorm", size, epsilon)?,
            layers: layers.collect::<Result<_, _>>()?,
        })
    }

    /// How many tokens a text may have.
    pub fn positions(&self) -> usize {
        self.positions.n_rows()
    }

    /// The states of the tokens, a row each.
    pub fn forward(&self, ids: &[u32]) -> Result<Matrix, String> {
        let mut states = Matrix::zeros(ids.len(), self.words.columns);
        for (n, id) in ids.iter().enumerate() {
            let id = *id as usize;
            if id >= self.words.n_rows() || n >= self.positions() {
                return Err(format!("the model has no word piece {id}: another vocabulary?"));
            }
            let parts = [self.words.row(id), self.positions.row(n), self.kinds.row(0)];
            for part in parts {
                states.row_mut(n).iter_mut().zip(part).for_each(|(x, y)| *x += y);
            }
        }
        self.norm.apply(&mut states);
        self.layers.iter().for_each(|layer| layer.apply(&mut states));
        Ok(states)
    }
}

fn config(path: &Path) -> Result<Config, EmbedError> {
    let document = json(path)?.ok_or_else(|| {
        EmbedError::new(
            path,
            "there is no such file: name a folder that sentence-transformers saved",
        )
    })?;
    let config = Config::deserialize(document).map_err(|error| EmbedError::new(path, error))?;
    let wrong = |what: String| Err(EmbedError::new(path, what));
    let Config { model_type, hidden_act, hidden_size, num_attention_heads, .. } = &config;
    if model_type != "bert" {
        return wrong(format!("the model is of type {model_type:?}: only \"bert\" is read"));
    }
    if hidden_act != "gelu" {
        return wrong(format!("hidden_act is {hidden_act:?}: only \"gelu\" is read"));
    }
    if config.position_embedding_type.as_ref().is_some_and(|kind| kind != "absolute") {
        return wrong("position_embedding_type must be \"absolute\"".to_owned());
    }
    let divides = *num_attention_heads > 0 && hidden_size.is_multiple_of(*num_attention_heads);
    if !divides || *hidden_size == 0 || config.num_hidden_layers > MAX_LAYERS {
        return wrong("its sizes do not fit each other".to_owned());
    }
    Ok(config)
}

impl Layer {
    fn load(tensors: &Tensors<'_>, config: &Config, n: usize) -> Result<Self, EmbedError> {
        let (size, wide) = (config.hidden_size, config.intermediate_size);
        let name = |part: &str| format!("encoder.layer.{n}.{part}");
        let square = |part: &str| tensors.linear(&name(part), size, size);
        let norm = |part: &str| tensors.norm(&name(part), size, config.layer_norm_eps);
        Ok(Self {
            heads: config.num_attention_heads,
            query: square("attention.self.query")?,
            key: square("attention.self.key")?,
            value: square("attention.self.value")?,
            mix: square("attention.output.dense")?,
            mix_norm: norm("attention.output.LayerNorm")?,
            widen: tensors.linear(&name("intermediate.dense"), wide, size)?,
            narrow: tensors.linear(&name("output.dense"), size, wide)?,
            norm: norm("output.LayerNorm")?,
        })
    }

    fn apply(&self, states: &mut Matrix) {
        let attended = self.mix.apply(&self.attend(states));
        states.add(&attended);
        self.mix_norm.apply(states);
        let mut wide = self.widen.apply(states);
        wide.values.iter_mut().for_each(|x| *x = gelu(*x));
        states.add(&self.narrow.apply(&wide));
        self.norm.apply(states);
    }

    /// softmax(Q Kᵀ/√d) V, each head by itself.
    fn attend(&self, states: &Matrix) -> Matrix {
        let [query, key, value] = [&self.query, &self.key, &self.value].map(|l| l.apply(states));
        let (tokens, width) = (states.n_rows(), states.columns / self.heads);
        let scale = 1.0 / (width as f32).sqrt();
        let mut output = Matrix::zeros(tokens, states.columns);
        let mut weights = vec![0.0; tokens];
        for head in 0..self.heads {
            let part = head * width..(head + 1) * width;
            for n in 0..tokens {
                let asked = &query.row(n)[part.clone()];
                for (m, weight) in weights.iter_mut().enumerate() {
                    *weight = dot(asked, &key.row(m)[part.clone()]) * scale;
                }
                softmax(&mut weights);
                let out = &mut output.row_mut(n)[part.clone()];
                for (m, weight) in weights.iter().enumerate() {
                    let values = &value.row(m)[part.clone()];
                    out.iter_mut().zip(values).for_each(|(x, v)| *x += weight * v);
                }
            }
        }
        output
    }
}
