#!/usr/bin/env python3
"""Decodes every protobuf message of a recording by the schemas embedded in it, and nothing else.

Usage: check_recording.py FILE [INFO]
  INFO  what `scenefold info --json FILE` prints; the counts must agree

Prints as JSON what was found; exits with 1 and says why if anything is wrong.
"""
import collections
import json
import sys

from google.protobuf.descriptor_pb2 import FileDescriptorSet
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

OWN = {
    "/graph/initial": "scenefold.v1.GraphState",
    "/human/utterance": "scenefold.v1.Utterance",
    "/robot/task": "scenefold.v1.Task",
    "/robot/task_status": "scenefold.v1.TaskStatus",
    "/clock": "scenefold.v1.Tick",
    "/evidence/interpretation": "scenefold.v1.Interpretation",
    "/change": "scenefold.v1.ChangeRecord",
    "/primitive": "scenefold.v1.Transaction",
    "/checkpoint": "scenefold.v1.Checkpoint",
}


def fail(why):
    sys.exit(f"error: {why}")


def check_schema(schema):
    """Every file comes after those that it imports, so that any reader can add them in turn."""
    known = set()
    files = FileDescriptorSet.FromString(schema.data).file
    for file in files:
        for needed in file.dependency:
            if needed not in known:
                fail(f"{schema.name}: {file.name} comes before {needed}, which it imports")
        known.add(file.name)
    names = {f"{file.package}.{message.name}" for file in files for message in file.message_type}
    if schema.name not in names:
        fail(f"{schema.name} is not defined in its own schema")


def walk(message):
    """Touches every field, so that everything is decoded."""
    for field, value in message.ListFields():
        for item in value if field.is_repeated else [value]:
            if field.message_type is not None:
                walk(item)


def main(path, info):
    counts, orders, primitives, checked = collections.Counter(), [], 0, set()
    with open(path, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()], validate_crcs=True)
        for schema, channel, message in reader.iter_messages(log_time_order=True):
            counts[channel.topic] += 1
            if channel.topic != "/checkpoint":
                orders.append(message.sequence)
            if channel.message_encoding != "protobuf":
                continue
            if OWN.get(channel.topic, schema.name) != schema.name:
                fail(f"{channel.topic} has schema {schema.name}")
            if schema.id not in checked:
                check_schema(schema)
                checked.add(schema.id)
        for schema, channel, message, decoded in reader.iter_decoded_messages(
            topics=list(OWN), log_time_order=True
        ):
            walk(decoded)
            if channel.topic == "/primitive":
                primitives += len(decoded.steps)
    if orders != list(range(1, len(orders) + 1)):
        fail(f"events are not numbered in order: {orders}")
    result = {
        "messages": sum(counts.values()),
        "primitives": primitives,
        "schemas": len(checked),
        "channels": dict(sorted(counts.items())),
    }
    if info is not None:
        compare(result, info)
    json.dump(result, sys.stdout)
    print()


def compare(result, info):
    by_topic = collections.Counter()
    for channel in info["channels"]:
        by_topic[channel["topic"]] += channel["count"]
    for name, mine, theirs in [
        ("messages", result["messages"], info["messages"]),
        ("primitives", result["primitives"], info["primitives"]),
        ("channels", result["channels"], dict(by_topic)),
        ("changes", result["channels"].get("/change", 0), info["changes"]),
        ("checkpoints", result["channels"].get("/checkpoint", 0), info["checkpoints"]),
    ]:
        if mine != theirs:
            fail(f"{name}: {mine} here, {theirs} in info")


if __name__ == "__main__":
    told = None
    if len(sys.argv) > 2:
        with open(sys.argv[2], encoding="utf-8") as text:
            told = json.load(text)
    main(sys.argv[1], told)
