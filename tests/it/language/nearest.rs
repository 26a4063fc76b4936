//! Label embeddings: a model that others trained gives the numbers that others got.

use std::path::{Path, PathBuf};

use scenefold::event::Event;
use scenefold::modality::human::{
    LanguageModel, LanguageRequest, NEAREST_PROMPT, Nearest, NearestQuestion, Question,
};
use scenefold::model::embed::Embeddings;

/// A model of 8 numbers, one layer and the vocabulary `mug cup sofa`, its weights from a formula.
pub fn tiny(folder: &Path) {
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("vocab.txt", "[PAD]\n[UNK]\n[CLS]\n[SEP]\nmug\ncup\nsofa\n##s\n");
    write(
        "config.json",
        r#"{"model_type":"bert","hidden_size":8,"num_hidden_layers":1,"num_attention_heads":2,
            "intermediate_size":16,"hidden_act":"gelu","layer_norm_eps":1e-12}"#,
    );
    let (mut header, mut data) = (serde_json::Map::new(), Vec::new());
    for (name, shape) in tensors() {
        let start = data.len();
        for n in 0..shape.iter().product::<usize>() {
            let value = ((n * 37 + name.len() * 11) % 23) as f32 / 23.0 - 0.5;
            data.extend_from_slice(&value.to_le_bytes());
        }
        let offsets = [start, data.len()];
        let entry = serde_json::json!({"dtype": "F32", "shape": shape, "data_offsets": offsets});
        header.insert(name, entry);
    }
    let header = serde_json::Value::Object(header).to_string();
    let file = [&(header.len() as u64).to_le_bytes(), header.as_bytes(), &data].concat();
    std::fs::write(folder.join("model.safetensors"), file).unwrap();
}

fn tensors() -> Vec<(String, Vec<usize>)> {
    let mut all = vec![
        ("embeddings.word_embeddings.weight".to_owned(), vec![8, 8]),
        ("embeddings.position_embeddings.weight".to_owned(), vec![12, 8]),
        ("embeddings.token_type_embeddings.weight".to_owned(), vec![2, 8]),
    ];
    let mut pair = |name: &str, weight: &[usize], bias: usize| {
        all.push((format!("{name}.weight"), weight.to_vec()));
        all.push((format!("{name}.bias"), vec![bias]));
    };
    pair("embeddings.LayerNorm", &[8], 8);
    for part in ["self.query", "self.key", "self.value", "output.dense"] {
        pair(&format!("encoder.layer.0.attention.{part}"), &[8, 8], 8);
    }
    pair("encoder.layer.0.attention.output.LayerNorm", &[8], 8);
    pair("encoder.layer.0.intermediate.dense", &[16, 8], 16);
    pair("encoder.layer.0.output.dense", &[8, 16], 8);
    pair("encoder.layer.0.output.LayerNorm", &[8], 8);
    all
}

fn ask(model: &mut Embeddings, names: &[&str], labels: &[&str]) -> Nearest {
    let texts = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect();
    let question = NearestQuestion { names: texts(names), labels: texts(labels) };
    let request = LanguageRequest { prompt: NEAREST_PROMPT, question: Question::Nearest(question) };
    let reply = model.answer(&request);
    let event = Event::LanguageReply(reply.clone());
    event.check_length().unwrap();
    Nearest::parse(&reply.answer.unwrap(), -1.0).unwrap()
}

#[test]
fn a_label_is_nearest_to_itself() {
    let folder = tempfile::tempdir().unwrap();
    tiny(folder.path());
    let mut model = Embeddings::load(folder.path()).unwrap();
    let nearest = ask(&mut model, &["Mugs", "cup", "🛋"], &["cup", "mug", "sofa", "mugs"]);
    let found = |name: &str| nearest.label(name).unwrap().clone();
    assert_eq!((&*found("Mugs").label, &*found("cup").label), ("mugs", "cup"));
    assert!((found("cup").similarity - 1.0).abs() < 1e-6);
    assert!(found("🛋").similarity <= 1.0 + 1e-6);
    let long = "mug ".repeat(1000);
    assert_eq!(model.embed(&long).unwrap().len(), 8);
}

#[test]
fn a_folder_that_holds_no_model_is_refused_by_file() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |because: &str| {
        let error = Embeddings::load(folder.path()).err().unwrap().to_string();
        assert!(error.contains(because), "{error}");
    };
    refused("neither vocab.txt nor tokenizer.json");
    tiny(folder.path());
    let config = folder.path().join("config.json");
    let text = std::fs::read_to_string(&config).unwrap();
    for (from, to, because) in [
        (r#""bert""#, r#""mpnet""#, "mpnet"),
        (r#""gelu""#, r#""swish""#, "swish"),
        (r#"heads":2"#, r#"heads":3"#, "do not fit"),
        (r#"heads":2"#, r#"heads":0"#, "do not fit"),
        (r#"layers":1"#, r#"layers":2"#, "encoder.layer.1"),
        (r#"size":16"#, r#"size":17"#, "instead of [17, 8]"),
        (r#"hidden_size":8"#, r#"hidden_size":"8""#, "config.json"),
    ] {
        std::fs::write(&config, text.replacen(from, to, 1)).unwrap();
        refused(because);
    }
    std::fs::remove_file(&config).unwrap();
    refused("config.json");
}

/// The folder of all-MiniLM-L6-v2, if there is one: `.ci/run` installs it.
fn minilm() -> Option<PathBuf> {
    std::env::var_os("SCENEFOLD_MINILM").map(PathBuf::from)
}

/// The similarities that sbert.net prints for this model ("Quickstart", sentence-transformers
/// and `PyTorch`).
#[test]
fn similarities_are_those_that_others_publish() {
    let Some(folder) = minilm() else { return };
    let model = Embeddings::load(&folder).unwrap();
    let sentences =
        ["The weather is lovely today.", "It's so sunny outside!", "He drove to the stadium."];
    let embedded = sentences.map(|sentence| model.embed(sentence).unwrap());
    for (a, b, published) in [(0, 1, 0.6660), (0, 2, 0.1046), (1, 2, 0.1411), (2, 2, 1.0)] {
        let found: f32 = embedded[a].iter().zip(&embedded[b]).map(|(x, y)| x * y).sum();
        assert!((found - published).abs() < 6e-5, "{a} {b}: {found}, published {published}");
    }
}

#[test]
fn things_of_a_house_are_nearest_to_their_synonyms() {
    let Some(folder) = minilm() else { return };
    let mut model = Embeddings::load(&folder).unwrap();
    let labels = ["couch", "tv remote", "mug", "plant", "wastebasket"];
    let names = ["sofa", "coffee cup", "trash can"];
    let nearest = ask(&mut model, &names, &labels);
    let labels = names.map(|name| nearest.label(name).unwrap().label.clone());
    assert_eq!(labels, ["couch", "mug", "wastebasket"]);
}

/// Of twelve pairs of synonyms nine are above it ("ficus" and "plant" are not), of twelve pairs of
/// things that stand side by side none; here are those next to it.
#[test]
fn the_default_threshold_lies_between_synonyms_and_neighbours() {
    let Some(folder) = minilm() else { return };
    let model = Embeddings::load(&folder).unwrap();
    let near = |a: &str, b: &str| model.similarity(a, b).unwrap() >= 0.6;
    assert!(near("duvet", "blanket") && near("coffee cup", "mug"));
    assert!(!near("pillow", "blanket") && !near("laptop", "keyboard"));
}
