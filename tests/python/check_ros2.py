#!/usr/bin/env python3
"""Decodes every CDR message of a recording by the schemas embedded in it.

Usage: check_ros2.py FILE

Prints the number of messages by topic and type as JSON.
"""
import collections
import json
import sys

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory


def main(path):
    counts = collections.Counter()
    with open(path, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()], validate_crcs=True)
        topics = {
            channel.topic
            for channel in reader.get_summary().channels.values()
            if channel.message_encoding == "cdr"
        }
        for schema, channel, _, decoded in reader.iter_decoded_messages(topics=list(topics)):
            if schema.name == "tf2_msgs/msg/TFMessage":
                for transform in decoded.transforms:
                    assert transform.header.frame_id and transform.child_frame_id
            if schema.name.startswith("sensor_msgs/"):
                assert decoded.header.frame_id
            counts[f"{channel.topic} {schema.name}"] += 1
    json.dump(dict(sorted(counts.items())), sys.stdout)
    print()


if __name__ == "__main__":
    main(sys.argv[1])
