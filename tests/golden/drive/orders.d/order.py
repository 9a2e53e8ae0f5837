"""Lines of a script for `kbc drive --orders`: what a master says, in few words."""
import json

SAID = {}


def header(topic):
    SAID[topic] = SAID.get(topic, -1) + 1
    return {"headerId": SAID[topic], "timestamp": "1970-01-01T00:00:00.00Z", "version": "2.1.0", "manufacturer": "Waymark", "serialNumber": "1"}


def say(t, topic, message):
    print(json.dumps({"t": t, "topic": topic, "message": {**header(topic), **message}}))


def action(kind, name, blocking="HARD", **parameters):
    return {"actionType": kind, "actionId": name, "blockingType": blocking,
            "actionParameters": [{"key": key, "value": value} for key, value in parameters.items()]}


def order(t, name, way, base=None, update=0, first=0, actions={}, on={}, limits={}, at={}):
    """`way`: nodes, of which the first `base` are released (all, if nothing is said); `first`: the sequenceId of the first; `actions`: by node;
    `on`: actions of edges, by the node that they lead to; `limits`: maxSpeed by the node that an edge leads to; `at`: nodePosition by node."""
    base = len(way) if base is None else base
    nodes = [{"nodeId": node, "sequenceId": first + 2 * i, "released": i < base, "actions": actions.get(node, []),
              **({"nodePosition": at[node]} if node in at else {})} for i, node in enumerate(way)]
    edges = [{"edgeId": f"{a}-{b}", "sequenceId": first + 2 * i + 1, "released": i + 1 < base, "startNodeId": a, "endNodeId": b, "actions": on.get(b, []),
              **({"maxSpeed": limits[b]} if b in limits else {})}
             for i, (a, b) in enumerate(zip(way, way[1:]))]
    say(t, "order", {"orderId": name, "orderUpdateId": update, "nodes": nodes, "edges": edges})


def instant(t, kind, name, **parameters):
    say(t, "instantActions", {"actions": [action(kind, name, "NONE", **parameters)]})
