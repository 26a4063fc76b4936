"""Writes a tiny language model with random weights: usage: make_model.py FILE.gguf

Two layers, 32 numbers wide, a vocabulary of single characters. What it says is noise; a server
that constrains its answers must make JSON of the schema of it all the same. One dimension of the
embeddings is constant, so that a row of the output can be given a bias: the characters that end
texts and lists have one, or the noise would never end.
"""

import sys

import gguf
import numpy as np

WIDTH, HEADS, INNER, LAYERS = 32, 4, 64, 2
BIAS = {'"': 18.0, "]": 3.0, "}": 1.5, "{": 14.0, "r": 1.0, "n": 6.0}
# The louder the context, the less the noise depends on the last character alone.
CONTEXT = 4.0


def vocabulary():
    normal, control, unknown, byte = 1, 3, 2, 6
    tokens = [("<unk>", unknown), ("<s>", control), ("</s>", control)]
    tokens += [(f"<0x{n:02X}>", byte) for n in range(256)]
    tokens += [(chr(n), normal) for n in range(33, 127)]
    # The tokenizer writes a space like this.
    return tokens + [("\u2581", normal)]


def main(path):
    random = np.random.default_rng(7)
    tokens = vocabulary()

    def matrix(rows, columns):
        return random.normal(0, columns**-0.5, (rows, columns)).astype(np.float32)

    embedding = matrix(len(tokens), WIDTH)
    embedding[:, 0] = 1.0
    output = matrix(len(tokens), WIDTH)
    output[:, 0] = 0.0
    for n, (text, _) in enumerate(tokens):
        output[n, 0] = BIAS.get(text, 0.0)
    # The server's grammar lets control characters stand within texts, which no JSON may have.
    # No model that was trained writes them; neither does this one.
    for byte in range(32):
        output[tokens.index((f"<0x{byte:02X}>", 6)), 0] = -100.0

    writer = gguf.GGUFWriter(path, "llama")
    writer.add_name("noise")
    writer.add_context_length(16384)
    writer.add_embedding_length(WIDTH)
    writer.add_block_count(LAYERS)
    writer.add_feed_forward_length(INNER)
    writer.add_head_count(HEADS)
    writer.add_head_count_kv(HEADS)
    writer.add_layer_norm_rms_eps(1e-5)
    writer.add_rope_dimension_count(WIDTH // HEADS)
    writer.add_file_type(gguf.LlamaFileType.ALL_F32)
    writer.add_tokenizer_model("llama")
    writer.add_token_list([text for text, _ in tokens])
    writer.add_token_scores([0.0 if kind == 1 else -1000.0 for _, kind in tokens])
    writer.add_token_types([kind for _, kind in tokens])
    writer.add_unk_token_id(0)
    writer.add_bos_token_id(1)
    writer.add_eos_token_id(2)
    writer.add_tensor("token_embd.weight", embedding)
    writer.add_tensor("output_norm.weight", np.ones(WIDTH, dtype=np.float32))
    writer.add_tensor("output.weight", output)
    for n in range(LAYERS):
        for part in ("attn_norm", "ffn_norm"):
            writer.add_tensor(f"blk.{n}.{part}.weight", np.ones(WIDTH, dtype=np.float32))
        for part in ("attn_q", "attn_k", "attn_v", "attn_output"):
            weights = matrix(WIDTH, WIDTH) * (1.0 if part == "attn_output" else CONTEXT)
            if part == "attn_output":
                weights[0] = 0.0  # what is constant stays so
            writer.add_tensor(f"blk.{n}.{part}.weight", weights)
        for part, rows, columns in (
            ("ffn_gate", INNER, WIDTH),
            ("ffn_up", INNER, WIDTH),
            ("ffn_down", WIDTH, INNER),
        ):
            weights = matrix(rows, columns)
            if part == "ffn_down":
                weights[0] = 0.0
            writer.add_tensor(f"blk.{n}.{part}.weight", weights)
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()


if __name__ == "__main__":
    main(sys.argv[1])
