"""What a vehicle told of itself, a line for each time that its order, its place or what is wrong has changed: states.py MESSAGES"""
import json
import sys

before = None
for line in open(sys.argv[1], encoding='utf-8'):
    said = json.loads(line)
    if said['from'] != 'vehicle' or said['topic'] != 'state':
        continue
    state = said['message']
    edges = ' '.join(edge['edgeId'] for edge in state['edgeStates'])
    at = state.get('agvPosition')
    here = (state['orderId'], state['lastNodeId'], edges, [error["errorDescription"] for error in state['errors']], at and at['mapId'])
    if here != before:
        place = f"{at['mapId']} ({at['x']:.1f}, {at['y']:.1f})" if at else 'no place'
        print(f"{state['orderId'] or '-'}: at {state['lastNodeId'] or '-'}, {place}, to drive: {edges or '-'}", *here[3], sep='; ')
    before = here
