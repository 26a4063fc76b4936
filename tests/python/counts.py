#!/usr/bin/env python3
"""Prints how many messages the `mcap` package finds on each topic of a file, as JSON.

Usage: counts.py FILE
"""
import collections
import json
import sys

from mcap.reader import make_reader
from mcap.stream_reader import StreamReader


def with_reader(stream):
    """By the index, as most programs read."""
    reader = make_reader(stream)
    for schema, channel, _ in reader.iter_messages():
        yield channel.topic, schema.name if schema else ""


def with_stream(stream):
    """Record by record, for files without a summary."""
    schemas, channels = {}, {}
    for record in StreamReader(stream).records:
        kind = type(record).__name__
        if kind == "Schema":
            schemas[record.id] = record
        elif kind == "Channel":
            channels[record.id] = record
        elif kind == "Message":
            channel = channels[record.channel_id]
            schema = schemas.get(channel.schema_id)
            yield channel.topic, schema.name if schema else ""


def main(path):
    results = []
    for read in (with_reader, with_stream):
        with open(path, "rb") as stream:
            results.append(collections.Counter(read(stream)))
    if results[0] != results[1]:
        sys.exit(f"the two readers of the mcap package disagree: {results}")
    channels = [
        {"topic": topic, "schema": schema, "count": count}
        for (topic, schema), count in sorted(results[0].items())
    ]
    json.dump({"messages": sum(results[0].values()), "channels": channels}, sys.stdout)
    print()


if __name__ == "__main__":
    main(sys.argv[1])
