"""Names that get other names, as an editor does it."""
import re

from editor import Editor, cut, expect, place

BASE = '''# A Wall is near.
names Side { left, right }
facts Wall[Side]
'''
MAIN = '''import "base.kb"
levels think > act
strategies Drive { ahead, back }
satellite Halted   # Halted: it stands
sensor eye 0..1
prototype dark = gaussian(0.9, 0.2)
fact Line = eye ~ dark
relation Wish(side, next)
    satellites exclusive
row first in Wish(side: left, next: second)
row second in Wish(side: right)
table other(Side) -> Side { left: right  right: left }
rule halt at think when any Wall and sat Drive.ahead then +Halted, -sat Drive.ahead
rule ahead[s in Side] at think when lost Wall[s] and Wall[other(s)] then +sat Drive.ahead
rule hand_on[w in Wish] at think when w and Wall[w.side] and Halted and Line then +w.next
rule again[s in Side] at think when Wall[s] for 1 s then +sat Drive.back
fuzzy Slow {
    input  far 0..4 m { near = ramp(1, 0.3) }
    output speed 0..0.5 m/s { slow = 0.1 } by average default slow
    far is near -> speed = slow
}
strategy Rest
control Rest = Slow(far: 1 m)
control Drive[d] = go(way: d)
'''
TOWN = '''map Town {
    landmark Dock at (0, 0)
    landmark Inn  at (1, 0)
    road Dock.E -- Inn.gate by mark
}
'''
MISSION = '''import std.navigation
import "town.kb"
names Direction more { gate }
table turn_of more { gate  N: forward  E: forward  S: forward  W: forward }
table turn_of more { N E S W gate  gate: forward forward forward forward forward }
command Go
route Errand on Town by Go: Dock -> Inn
rule arrived at goal when seen Inn and Errand then reset
'''


def begin(kbc, library, documents=True):
    editor = Editor(kbc, '--library', library, '-w')
    result = editor.begin(workspace={'workspaceEdit': {'documentChanges': documents}}, textDocument={'rename': {'prepareSupport': documents}})
    expect(result['capabilities']['renameProvider'] == ({'prepareProvider': True} if documents else True), 'names can be renamed')
    return editor


def edited(text, edits):
    lines = text.split('\n')
    for edit in sorted(edits, key=lambda edit: -edit['range']['start']['character']):
        begin, end = edit['range']['start'], edit['range']['end']
        line = lines[begin['line']].encode('utf-16-le')
        lines[begin['line']] = (line[:2 * begin['character']] + edit['newText'].encode('utf-16-le') + line[2 * end['character']:]).decode('utf-16-le')
    return '\n'.join(lines)


def renamed(text, name):
    """All places of a word outside of comments."""
    return '\n'.join(re.sub(rf'\b{name}\b', 'Fresh', line.split('#')[0]) + line[len(line.split('#')[0]):] for line in text.split('\n'))


def refusal(editor, uri, text, at, name='Fresh'):
    answer = editor.ask_whole('textDocument/rename', {'textDocument': {'uri': uri}, 'position': place(text, at), 'newName': name})
    expect('error' in answer and answer['error']['code'] == -32803, f'`{at}` is not renamed to {name}: {answer.get("error", {}).get("message")}')
    return answer['error']['message']


def each_kind_of_name(kbc, library, folder):
    base, main = folder / 'base.kb', folder / 'robot.kb'
    base.write_text(BASE)
    main.write_text('not what is open')
    editor = begin(kbc, library)
    uri = editor.open(main, MAIN)
    editor.change(uri, MAIN)
    expect(editor.messages_of(uri) == [], 'the knowledge base is sound')
    member = MAIN.replace('{ ahead', '{ Fresh').replace('Drive.ahead', 'Drive.Fresh')
    cases = [(at, renamed(MAIN, name or at), renamed(BASE, name or at)) for at, name in (
        ('Wall and', 'Wall'), ('Halted', ''), ('Drive.back', 'Drive'), ('Side]', 'Side'), ('eye', ''), ('dark', ''), ('Line', ''), ('Wish', ''),
        ('second)', 'second'), ('other(', 'other'), ('think', ''), ('halt', ''), ('Slow(', 'Slow'),
        ('next)', 'next'), ('side,', 'side'), ('far 0', 'far'), ('speed 0', 'speed'), ('near =', 'near'), ('slow =', 'slow'))]
    cases += [('ahead,', member, BASE), ('ahead then', member, BASE), ('ahead[', MAIN.replace('rule ahead', 'rule Fresh'), BASE),
              ('left,', renamed(MAIN, 'left'), renamed(BASE, 'left')), ('s] and', MAIN.replace('[s in Side] at think when lost Wall[s] and Wall[other(s)]', '[Fresh in Side] at think when lost Wall[Fresh] and Wall[other(Fresh)]'), BASE),
              ('d]', MAIN.replace('Drive[d] = go(way: d)', 'Drive[Fresh] = go(way: Fresh)'), BASE), ('w.next', re.sub(r'\bw\b', 'Fresh', MAIN), BASE)]
    for at, text, other in cases:
        ready = editor.of(uri, 'prepareRename', MAIN, at)
        expect(cut(MAIN, ready['range']) == ready['placeholder'] and at.startswith(ready['placeholder']), f'`{at}` can be renamed')
        changes = {change['textDocument']['uri']: change for change in editor.of(uri, 'rename', MAIN, at, newName='Fresh')['documentChanges']}
        expect({uri: change['textDocument']['version'] for uri, change in changes.items()} == {uri: 2} | ({base.as_uri(): None} if other != BASE else {}), 'in the text that is open, by its version, and in those that are not')
        expect(edited(MAIN, changes[uri]['edits']) == text, f'all of `{ready["placeholder"]}` and nothing else')
        expect(other == BASE or edited(BASE, changes[base.as_uri()]['edits']) == other, 'in the other file as well')
        found = editor.of(uri, 'references', MAIN, at, context={'includeDeclaration': True})
        expect(sorted(str(one['range']) for one in found) == sorted(str(edit['range']) for change in changes.values() for edit in change['edits']), 'these are its references')
        base.write_text(other)
        editor.change(uri, text)
        editor.tell('workspace/didChangeWatchedFiles', {'changes': [{'uri': base.as_uri(), 'type': 2}]})
        expect(editor.messages_of(uri) == [], 'and all is as sound as before')
        base.write_text(BASE)
        editor.change(uri, MAIN)
        editor.tell('workspace/didChangeWatchedFiles', {'changes': [{'uri': base.as_uri(), 'type': 2}]})
    for at in ('when', 'levels', '"base', 'Halted: it', 'go(', 'way', 's then +sat Drive.back'):
        expect(editor.of(uri, 'prepareRename', MAIN, at) is None, f'`{at}` is nothing that can be renamed')
        refusal(editor, uri, MAIN, at)
    expect(editor.of(uri, 'rename', MAIN, 'Halted', newName='Halted') is None, 'a name that stays changes nothing')
    for at, name, why in (('Halted', 'Line', 'fact `Line` is declared at'), ('Halted', 'Wall', 'base.kb:3:7'), ('think', 'act', 'level `act`'), ('halt', 'again', 'rule `again`'),
                          ('left,', 'right', ''), ('s] and', 'Wall', ''), ('Line', 'w', ''), ('Halted', 'rule', 'word of the language'), ('Halted', 'reset', 'word of the language'), ('Halted', '2nd', 'is no name'), ('Halted', 'a b', 'is no name'),
                          ('Halted', '', 'is no name'), ('Halted', 'x' * 256, '255 bytes'), ('back }', 'ahead', ''), ('d]', 'back', '')):
        expect(why in refusal(editor, uri, MAIN, at, name), f'it says why: {why}')
    expect('changes' not in editor.of(uri, 'rename', MAIN, 'think', newName='map'), 'a level may be called as a word of the language')
    for control in ('control Drive[d] = go(way: d)\ncontrol Rest = go(way: back)\n', 'control Drive[d] = turn_on_line(turn: d)\n'):
        editor.change(uri, told := MAIN[:MAIN.index('control Rest')] + control)
        expect('is also the word that `' in refusal(editor, uri, told, 'back }'), 'a controller would not know the new name of what a variable hands to it')
    editor.change(uri, wrong := MAIN.replace('any Wall', 'any Wal'))
    expect('while there are errors' in refusal(editor, uri, wrong, 'Halted') and 'robot.kb:13:' in refusal(editor, uri, wrong, 'Halted'), 'of what has errors nothing is renamed')
    editor.change(uri, wrong := MAIN + 'rule')
    refusal(editor, uri, wrong, 'Halted')
    expect(editor.leave() == 0, 'the server leaves when it is told')


def maps_and_missions(kbc, library, folder):
    town, missions = folder / 'town.kb', [folder / 'one.kb', folder / 'two.kb']
    town.write_text(TOWN)
    texts = [MISSION, MISSION.replace('Errand', 'Round')]
    for path, text in zip(missions, texts):
        path.write_text(text)
    editor = begin(kbc, library, documents=False)
    uri = editor.open(missions[0])
    expect(editor.messages_of(uri) == [], 'the mission is sound')
    for at, name in (('Town', ''), ('Inn', ''), ('Dock', ''), ('gate', ''), ('Errand', ''), ('Go:', 'Go')):
        changes = editor.of(uri, 'rename', MISSION, at, newName='Fresh')['changes']
        for path, text in ((town, TOWN), *zip(missions, texts)):
            # Each mission has a `gate`, a `Go` and a `Errand` of its own; the map is that of both.
            shared = at in ('Town', 'Inn', 'Dock') or path != missions[1] or at == 'gate'
            expected = renamed(text, name or at) if shared else text
            expect(edited(text, changes.get(path.as_uri(), [])) == expected, f'`{name or at}` in {path.name}, open or not')
        found = editor.of(uri, 'references', MISSION, at, context={'includeDeclaration': True})
        expect(sorted((one['uri'], str(one['range'])) for one in found) == sorted((uri, str(edit['range'])) for uri, edits in changes.items() for edit in edits), 'these are its references')
    for at in ('Direction', 'turn_of', 'goal when', 'mark\n'):
        text, where = (TOWN, editor.open(town)) if at == 'mark\n' else (MISSION, uri)
        expect('of the standard library' in refusal(editor, where, text, at), 'what the library declares is not renamed')
    expect('satellite `Arrived` is declared at std/' in refusal(editor, uri, MISSION, 'Inn', 'Arrived'), 'nor is anything called as what it declares')
    missions[1].write_text(texts[1].replace('Inn', 'Inm'))
    expect('two.kb' in refusal(editor, uri, MISSION, 'Inn'), 'nor what another mission names that has errors')
    expect(editor.leave() == 0, 'the server leaves when it is told')


CASES = (each_kind_of_name, maps_and_missions)
