"""Decodes the camera topics of a recording with the ROS 2 support of the Python MCAP packages,
opens the pictures with Pillow, and prints what is in them as JSON."""

import io
import json
import struct
import sys

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from PIL import Image

COLOUR = "/camera/color/image/compressed"
DEPTH = "/camera/depth/image"
INFO = "/camera/color/camera_info"

colour, depth, info, frames = [], [], [], set()
with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, decoder_factories=[DecoderFactory()])
    for _, channel, message, decoded in reader.iter_decoded_messages([COLOUR, DEPTH, INFO, "/tf", "/tf_static"]):
        if channel.topic == COLOUR:
            picture = Image.open(io.BytesIO(bytes(decoded.data)))
            picture.load()
            colour.append([picture.width, picture.height, picture.format.lower(), decoded.format])
        elif channel.topic == DEPTH:
            pixels = struct.unpack(f"<{decoded.width * decoded.height}H", bytes(decoded.data))
            seen = [pixel for pixel in pixels if pixel]
            depth.append([decoded.width, decoded.height, decoded.encoding, decoded.step, len(seen), max(seen, default=0)])
        elif channel.topic == INFO:
            info.append([decoded.width, decoded.height, decoded.k[0], decoded.header.frame_id])
        else:
            frames |= {(t.header.frame_id, t.child_frame_id) for t in decoded.transforms}

print(json.dumps({
    "colour": len(colour), "colour_kinds": sorted({tuple(it) for it in colour}),
    "depth": len(depth), "depth_kinds": sorted({tuple(it[:4]) for it in depth}),
    "least_seen": min(it[4] for it in depth), "farthest_mm": max(it[5] for it in depth),
    "info": len(info), "info_kinds": sorted({tuple(it) for it in info}),
    "frames": sorted(frames),
}))
