#!/usr/bin/env python3
"""Loads a scene graph with the PyPI package `spark-dsg` and prints what is in it as JSON.

Usage: load_spark_dsg.py FILE
"""
import json
import sys

import spark_dsg as dsg


def main(path):
    graph = dsg.DynamicSceneGraph.load(path)

    def layer(name):
        return graph.get_layer(getattr(dsg.DsgLayers, name))

    def named(name):
        return sorted(node.attributes.name for node in layer(name).nodes)

    def boxes(name):
        return sum(node.attributes.bounding_box.is_valid() for node in layer(name).nodes)

    rooms = layer("ROOMS")
    objects = layer("OBJECTS")
    result = {
        "objects": objects.num_nodes(),
        "rooms": rooms.num_nodes(),
        "buildings": layer("BUILDINGS").num_nodes(),
        "places": layer("PLACES").num_nodes(),
        "accesses": rooms.num_edges(),
        "objects_in_rooms": sum(node.has_parent() for node in objects.nodes),
        "rooms_in_buildings": sum(node.has_parent() for node in rooms.nodes),
        "object_boxes": boxes("OBJECTS"),
        "room_boxes": boxes("ROOMS"),
        "object_labels": named("OBJECTS"),
        "room_labels": named("ROOMS"),
        "label_space": len(graph.get_labelspace(2, 0).labels_to_names),
        "supports": sum(
            (node.attributes.metadata.get().get("scenefold") or {}).get("support") is not None
            for node in objects.nodes
        ),
    }
    json.dump(result, sys.stdout)
    print()


if __name__ == "__main__":
    main(sys.argv[1])
