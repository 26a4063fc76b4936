#!/usr/bin/env python3
"""Writes a small scene graph with the PyPI package `spark-dsg` (newest format it knows).

Usage: make_spark_dsg.py FILE

Two rooms of one building, three places, three objects (one with a box that is turned, one
without a box, one that hangs below a room directly), one agent, a label space.
"""
import sys

import numpy as np
import spark_dsg as dsg


def box(kind, dimensions, centre, rotation=None):
    rotation = np.eye(3) if rotation is None else rotation
    return dsg.BoundingBox(kind, np.array(dimensions), np.array(centre), rotation)


def attributes(kind, position, name="", label=None, bounding_box=None, seen_ns=0):
    result = kind()
    result.position = np.array(position)
    if hasattr(result, "name"):
        result.name = name
    if label is not None:
        result.semantic_label = label
    if bounding_box is not None:
        result.bounding_box = bounding_box
    result.last_update_time_ns = seen_ns
    return result


def symbol(letter, index):
    return dsg.NodeSymbol(letter, index).value


def main(path):
    graph = dsg.DynamicSceneGraph()
    graph.set_labelspace(dsg.Labelspace({3: "mug", 7: "table", 9: "rug"}), 2, 0)
    aabb, raabb = dsg.BoundingBoxType.AABB, dsg.BoundingBoxType.RAABB
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    objects, places, rooms, buildings = "OBJECTS", "PLACES", "ROOMS", "BUILDINGS"

    seen = 1_767_571_200_000_000_000
    table = box(raabb, [2.0, 1.0, 0.8], [1.0, 1.0, 0.4], quarter)
    mug = box(aabb, [0.1, 0.1, 0.12], [1.0, 1.0, 0.86])
    obj = dsg.ObjectNodeAttributes
    graph.add_node(objects, symbol("O", 1), attributes(obj, [1, 1, 0.4], "O(1)", 7, table, seen))
    graph.add_node(objects, symbol("O", 2), attributes(obj, [1, 1, 0.86], "", 3, mug, seen + 1))
    graph.add_node(objects, symbol("O", 5), attributes(obj, [6, 1, 0], "red rug", 9))

    place = dsg.PlaceNodeAttributes
    for index, x in enumerate([0.5, 1.5, 6.0]):
        graph.add_node(places, symbol("p", index), attributes(place, [x, 1, 1]))

    room = dsg.RoomNodeAttributes
    kitchen = box(aabb, [4.0, 4.0, 2.5], [2.0, 2.0, 1.25])
    graph.add_node(rooms, symbol("R", 0), attributes(room, [2, 2, 1.25], "kitchen", None, kitchen))
    graph.add_node(rooms, symbol("R", 1), attributes(room, [6, 2, 1.25], "R(1)"))
    graph.add_node(
        buildings, symbol("B", 0), attributes(dsg.SemanticNodeAttributes, [4, 2, 1.25], "B(0)")
    )
    edges = [
        (("B", 0), ("R", 0)), (("B", 0), ("R", 1)), (("R", 0), ("R", 1)),
        (("R", 0), ("p", 0)), (("R", 0), ("p", 1)), (("R", 1), ("p", 2)),
        (("p", 0), ("p", 1)), (("p", 0), ("O", 1)), (("p", 1), ("O", 2)), (("R", 1), ("O", 5)),
    ]
    for source, target in edges:
        assert graph.insert_edge(symbol(*source), symbol(*target)), (source, target)

    agent = dsg.AgentNodeAttributes()
    agent.position = np.array([0.5, 0.5, 0.0])
    graph.add_node(2, symbol("a", 0), agent, ord("a"))
    graph.insert_edge(symbol("p", 0), symbol("a", 0))
    graph.save(path, include_mesh=False)


if __name__ == "__main__":
    main(sys.argv[1])
