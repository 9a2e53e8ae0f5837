"""What one meets while writing: text that is not complete, files that import each other from now on, names of all kinds, long lines, haste."""
import json
import resource

from editor import Editor, codes, cut, expect, place

MISSION = '''import std.navigation
# Where it drives.
map Town {
    landmark Dock at (0, 0)
    landmark Inn  at (1, 0)
    road Dock.E -- Inn.W by mark
}
command Go
route Errand on Town by Go: Dock -> Inn
detours on Errand when Closed[exit]
fuzzy Slow {
    input  far 0..4 m { near = ramp(1, 0.3) }
    output speed 0..0.5 m/s { slow = 0.1 } by average default slow
    far is near -> speed = slow
}
strategies Rest { near, still }
control Rest.near  = Slow(far: 1 m)
control Rest.still = keep_wall(side: left, speed: 0.2 m/s)
rule linger[l in Leg] at goal when l and seen l.to and Rest.near then +sat Rest.still
'''


def begin(kbc, library, **parameters):
    editor = Editor(kbc, '--library', library, '-w')
    editor.capabilities = editor.begin(parameters)['capabilities']
    return editor


def names_of_all_kinds(kbc, library, folder):
    editor = begin(kbc, library)
    uri = editor.open(folder / 'robot.kb', MISSION)
    expect(editor.messages_of(uri) == [], 'the mission is sound')
    for at, kind, places in (('far 0', 'input `far`', 3), ('near =', 'term `near`', 2), ('speed 0', 'output `speed`', 2), ('slow =', 'term `slow`', 3),
                             ('near, still', 'member `near` `of Rest`', 3), ('l in', 'variable `l`', 3), ('to and', 'field `to` `of Leg`', 0), ('exit]', 'field `exit` `of Leg`', 0),
                             ('mark\n', 'member `mark` `of Method`', 1), ('keep_wall', 'controller `keep_wall`', 1), ('side:', 'argument `side`', 1)):
        hover = editor.of(uri, 'hover', MISSION, at)
        expect(hover is not None and hover['contents']['value'].startswith(kind), f'`{at.strip()}` is told to be {kind}')
        found = editor.of(uri, 'documentHighlight', MISSION, at)
        expect(places == 0 or len(found) == places, f'{kind} stands at {places} places')
        expect({cut(MISSION, one['range']) for one in found} == {cut(MISSION, hover['range'])}, 'all of which are called so')
        declared = editor.of(uri, 'declaration', MISSION, at)
        expect(declared == editor.of(uri, 'definition', MISSION, at) and (declared is None) == kind.startswith(('controller', 'argument')), 'declared is what is not of the program')
    value = editor.of(uri, 'hover', MISSION, 'keep_wall')['contents']['value']
    expect('drives between walls' in value and '`side: both, left, right`' in value, 'a controller of Waymark is explained')
    [map_] = [one for one in editor.of(uri, 'documentSymbol') if one['name'] == 'Town']
    expect(cut(MISSION, map_['selectionRange']) == 'Town' and map_['range']['end']['line'] == 6 and [one['name'] for one in map_['children']] == ['Dock', 'Inn'], 'the outline has a map as a whole')
    [group] = [one for one in editor.of(uri, 'documentSymbol') if one['name'] == 'Rest']
    expect([one['name'] for one in group['children']] == ['near', 'still'], 'and a group with its members')
    expect([(one['name'], one['detail']) for one in editor.of(uri, 'documentSymbol')][-3:-1] == [('Rest.near', 'control = Slow'), ('Rest.still', 'control = keep_wall')], 'control lines are in it as well')
    found = editor.ask('workspace/symbol', {'query': 'iNn'})
    expect([one['name'] for one in found] == ['Inn'] and found[0]['location']['uri'] == uri, 'names are found in all that is open')
    expect({'startLine': 2, 'endLine': 6, 'kind': 'region'} in editor.of(uri, 'foldingRange'), 'statements can be folded')
    [inner] = editor.of(uri, 'selectionRange', positions=[place(MISSION, 'l.to')])
    words = []
    while inner:
        first, last = inner['range']['start']['line'], inner['range']['end']['line']
        words.append(cut(MISSION, inner['range']) if first == last else last - first)
        inner = inner.get('parent')
    expect(words[:3] == ['.', 'l.to', 'seen l.to'] and words[-2].startswith('rule linger') and words[-1] == MISSION.count('\n'), f'what is selected grows: {words}')
    [link] = editor.of(uri, 'documentLink')
    expect(cut(MISSION, link['range']) == 'std.navigation' and link['target'].endswith('/std/navigation.kb'), 'imports are links')
    expect(editor.leave() == 0, 'the server leaves when it is told')


def half_written(kbc, library, folder):
    editor = begin(kbc, library)
    uri = editor.open(folder / 'robot.kb', text := MISSION + 'rule next at goal when seen Dock and Er')
    expect(codes(editor.messages_of(uri)) == ['KB0221'], 'the file cannot be read as a whole')
    expect(editor.of(uri, 'hover', text, 'Dock at')['contents']['value'].startswith('Landmark `Dock`'), 'names in the rest of it are known')
    expect(len(editor.of(uri, 'references', text, 'Inn  at', context={'includeDeclaration': True})) == 3, 'and where they stand')
    expect('Town' in [one['name'] for one in editor.of(uri, 'documentSymbol')], 'and in the outline')

    def offered(written, more=''):
        editor.change(uri, MISSION + written + more)
        items = editor.of(uri, 'completion', position={'line': MISSION.count('\n') + written.count('\n'), 'character': len(written.rsplit('\n', 1)[-1])})
        return [item['label'] for item in items]
    expect({'Errand', 'Dock', 'Rest'} <= set(offered('rule next at goal when seen Dock and Er')), 'and are offered')
    expect('exit' in offered('detours on Errand when Closed[') and 'exit' not in offered('rule next at goal when Closed['), 'a detour may ask for the exit of its leg')
    expect('leg' in offered('detours on Errand when not seen le') and {'from', 'to', 'next'} <= set(offered('detours on Errand when not seen leg.')), 'and for the leg')
    expect({'ms', 'h'} <= set(offered('rule next at goal when Dock for 1 ')) and 'deg' not in offered('rule next at goal when Dock for 1 '), 'behind `for` units of time')
    expect({'Go', 'Inn'}.isdisjoint(offered('rule next at goal when Dock then +')), 'an effect writes no fact')
    expect(offered('set event = ') == [] and {'stop', 'hold'} <= set(offered('set idle = ')), 'words for the setting that takes some')
    (folder / 'maps').mkdir()
    (folder / 'maps' / 't\u00e4l.kb').write_text('')
    editor.change(uri, text := 'import "maps/t\u00e4')
    [item] = editor.of(uri, 'completion', position={'line': 0, 'character': len(text)})
    expect(item['textEdit'] == {'range': {'start': {'line': 0, 'character': 13}, 'end': {'line': 0, 'character': 15}}, 'newText': 't\u00e4l.kb'}, 'behind a quote files')
    expect([item['label'] for item in editor.of(uri, 'completion', position={'line': 0, 'character': 8})] == ['maps/'], 'and folders')
    expect({'from', 'to', 'next'} <= set(offered('rule next[x in Leg] at goal when x.')), 'behind the dot of a row its fields')
    expect({'from', 'to', 'next'} <= set(offered('rule next[x in Leg] at goal when x.next.')) and 'Leg' not in offered('rule next[x in Leg] at goal when x.'), 'and of what these hold')
    expect('W' in offered('map Sea {\n    landmark Quay\n    road Quay.'), 'exits in a map that is not closed')
    expect({'Quay', 'Pier'} <= set(offered('map Sea {\n    landmark Quay\n    landmark Pier\n    road ')), 'whose landmarks are offered')
    editor.change(uri, text := MISSION.replace('    far is near ->', '    far is\n    far is near ->'))
    [message] = editor.messages_of(uri)
    expect(cut(text, message['range']).strip() in ('far', '->', 'is') and editor.of(uri, 'hover', text, 'near =')['contents']['value'].startswith('term `near`'), 'a line of a fuzzy block that is not complete leaves the others')
    half = 'fuzzy Half {\n    input gap 0..1 m { wide = ramp(0, 1) }\n    output pace 0..1 { slow = 0.1 }\n    '
    expect({'given', 'gap'} <= set(offered(half)) and offered(half + 'gap is ') == ['not', 'very', 'somewhat', 'wide'] and offered(half + 'gap is wide -> ') == ['pace'], 'and the names of a block that is not complete')
    expect(offered(half + 'gap is not ')[-3:] == ['very', 'somewhat', 'wide'] and offered(half + 'gap is wide -> pace = ') == ['slow'], 'of terms those of the input or output that is named')
    two = 'fuzzy Two {\n    input gap 0..1 m { wide = ramp(0, 1) }\n    input turn -1..1 { left = ramp(0, -1), right = ramp(0, 1) }\n    output pace 0..1 { slow = 0.1, fast = 1 }\n    gap is wide and turn is left -> pace = slow\n    '
    for end in ('', '\n}\n'):
        expect('wide' in (asked := offered(two + 'gap is ', end)) and not {'left', 'right', 'slow', 'fast'} & set(asked), 'behind `is` only the terms of that input')
        expect({'left', 'right'} <= set(asked := offered(two + 'gap is wide and turn is ', end)) and 'wide' not in asked, 'and of the next one')
        expect({'slow', 'fast'} <= set(asked := offered(two + 'gap is wide -> pace = ', end)) and not {'left', 'wide'} & set(asked), 'and behind an output its own')
    expect(offered('# when D') == [], 'in comments nothing is')
    what_the_grammar_takes(offered)
    expect({'side', 'distance'} <= set(offered('strategy X\ncontrol X = keep_wall(speed: 1, ')) and 'speed' not in offered('strategy X\ncontrol X = keep_wall(speed: 1, '), 'what a controller takes, if it is not there')
    expect(offered('strategy X\ncontrol X = keep_wall(side: ') == ['both', 'left', 'right'], 'and the words of that')
    expect(offered('strategy X\ncontrol X = Slow(') == ['far'], 'and the inputs of a fuzzy block')
    editor.change(uri, text := MISSION + 'strategy X\ncontrol X = keep_wall(speed: 1, side: ')
    line = text.rsplit('\n', 1)[-1]
    help_ = editor.of(uri, 'signatureHelp', position={'line': text.count('\n'), 'character': len(line)})
    [one] = help_['signatures']
    expect(one['label'].startswith('keep_wall(') and one['parameters'][help_['activeParameter']]['label'] == 'side: both, left, right', 'and it is told while one writes')
    expect(editor.of(uri, 'signatureHelp', text, 'seen l.to') is None, 'elsewhere nothing is')
    editor.change(uri, text := 'import std.basics\nrule r at goal when Help.refused then reset\n')
    [message] = editor.messages_of(uri)
    [fix] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message], 'only': ['quickfix']})
    expect(fix['edit']['changes'][uri] == [{'range': {'start': {'line': 1, 'character': 0}, 'end': {'line': 1, 'character': 0}}, 'newText': 'import std.search\n'}], 'the import that is missing is a quick fix')
    expect(editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message], 'only': ['source.fixAll']}) == [], 'for who wants such')
    editor.change(uri, text := 'rule r at goal when Help.refused then reset\nimport std.basics')
    [message] = editor.messages_of(uri)
    [fix] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message], 'only': ['quickfix']})
    expect(fix['edit']['changes'][uri] == [{'range': {'start': {'line': 1, 'character': 17}, 'end': {'line': 1, 'character': 17}}, 'newText': '\nimport std.search'}], 'also where the last import ends the file')
    expect(editor.leave() == 0, 'the server leaves when it is told')


def what_the_grammar_takes(offered):
    rule = 'rule next[x in Leg] at goal'
    expect({'rule', 'fuzzy'} <= set(offered('')) and 'when' not in offered(''), 'where a line begins, a statement may')
    expect({'goal', 'drive'} <= set(offered('rule next at ')) and 'Dock' not in offered('rule next at '), 'behind `at` levels are offered')
    expect(offered(rule + '\n    ') == ['when', 'while'], 'behind a level what a rule goes on with')
    expect({'seen', 'x', 'Dock', 'Looking', 'Line'} <= set(asked := offered(rule + ' when ')) and not {'goal', 'Leg', 'mark', 'then'} & set(asked), 'conditions are of cells')
    expect({'then', 'and', 'for'} <= set(offered(rule + ' when Looking ')), 'and go on')
    expect({'ms', 's'} <= set(offered(rule + ' when Looking for 2 ')), 'numbers have units')
    expect({'low', 'zero', 'high'} <= set(offered(rule + ' when Looking is ')), 'and facts states')
    expect({'reset', 'sat', 'Looking'} <= set(asked := offered(rule + ' when Looking then ')) and 'Line' not in asked, 'satellites are written')
    expect({'Line', 'Rest'} <= set(asked := offered(rule + ' when Looking then +sat ')) and 'Looking' not in asked, 'and those of facts and strategies')
    expect(offered('rule next[') == [] and {'Leg', 'Direction'} <= set(asked := offered('rule next[x in ')) and 'Dock' not in asked, 'a variable has a new name, and ranges over rows or members')
    expect({'x', 'N', 'mark'} <= set(offered(rule + ' when Came[')), 'and stands in brackets, as members do')
    expect({'Rest', 'Move'} <= set(asked := offered('control ')) and 'Line' not in asked, 'strategies are driven')
    expect({'follow_line', 'Slow'} <= set(offered('control Rest.near = ')), 'by controllers and fuzzy blocks')
    expect(offered('route R on ') == ['Town'] and offered('route R on Town by ') == ['Go'] and offered('route R on Town by Go: Dock -> ') == ['Dock', 'Inn'], 'a route has a map, a command and landmarks')
    expect({'mark', 'dist'} <= set(asked := offered('map Sea {\n    landmark Quay\n    road Quay.N -- Quay.S by ')) and 'Quay' not in asked, 'a road a method')
    expect(offered('set ') == ['event', 'attention', 'firing', 'idle', 'hold_limit'] and {'stop', 'hold', 'Rest'} <= set(offered('set idle = ')), 'settings have names')
    expect({'from', 'exit'} <= set(asked := offered('row in Leg(to: Inn, ')) and 'to' not in asked, 'a row has the fields that are missing')
    expect({'lazy', 'attention'} <= set(offered('fact Near ')) and 'gaussian' in offered('sensor eye 0..1\nfact Near = eye ~ '), 'a fact says how it is seen')
    expect({'goal', 'Dock', 'rule', 'mark'} <= set(offered('rule next goal goal when ')), 'behind a mistake it may be anything')


def imports_that_come_and_go(kbc, library, folder):
    for name in ('maps', 'missions/far'):
        (folder / name).mkdir(parents=True)
    town, errand = folder / 'maps' / 'town.kb', folder / 'missions' / 'far' / 'errand.kb'
    town.write_text('facts Wall, Gate\n')
    errand.write_text(text := 'import "../../maps/town.kb"\nlevels a > b\nsatellite Stop output\nrule r at a when Gate then +Stop\n')
    editor = begin(kbc, library)
    uri, base = editor.open(errand), editor.open(town)
    expect(editor.messages_of(uri) == [] and editor.messages_of(base) == [], 'all is well at first')
    editor.change(base, 'facts Wall, Gait\n')
    editor.messages_of(uri)
    expect(codes(editor.messages[uri]) == ['KB0401'], 'what a file breaks in another that is open is told there')
    editor.change(uri, 'levels a > b\n')
    expect(editor.messages_of(uri) == [], 'without its import it does not matter')
    editor.change(base, 'facts Wall, Gait, Wal\nlevels x\n')
    expect(editor.messages_of(base) == [] and editor.of(base, 'hover', 'facts Wall, Gait, Wal\nlevels x\n', 'x') is not None, 'and the other one is judged by itself')
    editor.change(uri, text)
    expect(codes(editor.messages_of(uri)) != [], 'written again, and not saved, it counts')
    expect(editor.leave() == 0, 'the server leaves when it is told')

    editor = begin(kbc, library, workspaceFolders=[{'uri': folder.as_uri(), 'name': 'robot'}])
    expect(editor.capabilities['workspace']['workspaceFolders']['supported'], 'folders can be added')
    base = editor.open(town)
    expect(editor.messages_of(base) == [], 'a map of the folder is judged with the missions of the folder')
    editor.change(base, 'facts Wall, Gait\n')
    editor.messages_of(base)
    expect(codes(editor.messages.get(errand.as_uri(), [])) == ['KB0401'], 'however deep these lie')
    editor.tell('workspace/didChangeWorkspaceFolders', {'event': {'added': [], 'removed': [{'uri': folder.as_uri(), 'name': 'robot'}]}})
    editor.messages_of(base)
    expect(editor.messages[errand.as_uri()] == [], 'when the folder has gone, they are of no interest')
    editor.tell('workspace/didChangeWorkspaceFolders', {'event': {'added': [{'uri': folder.as_uri(), 'name': 'robot'}], 'removed': []}})
    errand.write_text(text.replace('Gate', 'Gait'))
    second = folder / 'missions' / 'second.kb'
    second.write_text(text.replace('../../', '../'))
    editor.tell('workspace/didChangeWatchedFiles', {'changes': [{'uri': second.as_uri(), 'type': 1}, {'uri': errand.as_uri(), 'type': 2}]})
    editor.messages_of(base)
    expect(editor.messages[errand.as_uri()] == [] and codes(editor.messages.get(second.as_uri(), [])) == ['KB0401'], 'a mission that is new there is found')
    second.unlink()
    editor.tell('workspace/didChangeWatchedFiles', {'changes': [{'uri': second.as_uri(), 'type': 3}]})
    editor.messages_of(base)
    expect(editor.messages[second.as_uri()] == [], 'and forgotten when it is deleted')
    expect(editor.leave() == 0, 'the server leaves when it is told')


def importers_elsewhere(kbc, library, folder):
    """`b/part.kb` is imported by `a/root.kb`, which is not open, and lies where nobody looks: it is known because of `a/near.kb`."""
    for name in ('a', 'b/c'):
        (folder / name).mkdir(parents=True)
    root, near, part = folder / 'a' / 'root.kb', folder / 'a' / 'near.kb', folder / 'b' / 'c' / 'part.kb'
    part.write_text('fact Wall\n')
    near.write_text('fact Gate\n')
    root.write_text('import "near.kb"\nimport "../b/c/part.kb"\nlevels a > b\nrule r at a when Wall and Gate then reset\n')
    editor = begin(kbc, library)
    uri, other = editor.open(part), editor.open(near)
    expect(editor.messages_of(uri) == [] and editor.messages_of(other) == [], 'all is well at first')
    editor.change(uri, 'fact Hole\n')
    editor.messages_of(uri)
    expect(codes(editor.messages.get(root.as_uri(), [])) == ['KB0401'], 'what it breaks is told')
    expect(len(editor.of(uri, 'references', 'fact Hole\n', 'Hole', context={'includeDeclaration': True})) == 1, 'it has one place now')
    editor.change(uri, 'fact Wall\n')
    expect(len(editor.of(uri, 'references', 'fact Wall\n', 'Wall', context={'includeDeclaration': True})) == 2, 'and two as it was')
    expect(editor.leave() == 0, 'the server leaves when it is told')


def haste(kbc, library, folder):
    editor = begin(kbc, library)
    uri = editor.open(folder / 'robot.kb', MISSION)
    expect(editor.ask_whole('initialize', {'capabilities': {}})['error']['code'] == -32600, 'a session begins once')
    burst = []
    for number in range(20):
        burst += [{'method': 'textDocument/didChange', 'params': {'textDocument': {'uri': uri, 'version': number + 2}, 'contentChanges': [{'text': MISSION + f'fact F{number} even'}]}},
                  {'id': f'tokens {number}', 'method': 'textDocument/semanticTokens/full', 'params': {'textDocument': {'uri': uri}}}]
        if number < 19:
            burst.append({'method': '$/cancelRequest', 'params': {'id': f'tokens {number}'}})
    bodies = [json.dumps({'jsonrpc': '2.0', **message}).encode() for message in burst]
    editor.process.stdin.write(b''.join(b'Content-Length: %d\r\n\r\n' % len(body) + body for body in bodies))
    editor.process.stdin.flush()
    answers = []
    while len(answers) < 20:
        message = editor.receive()
        answers += [message] if 'id' in message else []
    expect([one['id'] for one in answers] == [f'tokens {number}' for number in range(20)], 'each question has one answer, in their order')
    expect(all(one['error']['code'] == -32800 for one in answers if 'error' in one) and 'result' in answers[-1], 'those that nobody asks any longer have none')
    expect(sum('error' in one for one in answers) > 0, 'and cost nothing')
    expect(editor.told[-1]['version'] == 21, 'messages tell of which text they are')
    editor.send(id=99, method='shutdown', params=None)
    editor.send(id=100, method='textDocument/hover', params={'textDocument': {'uri': uri}, 'position': {'line': 0, 'character': 0}})
    while (message := editor.receive()).get('id') != 100:
        pass
    expect(message['error']['code'] == -32600, 'after `shutdown` nothing is answered')
    editor.tell('exit', None)
    expect(editor.process.wait(timeout=60) == 0, 'the server leaves when it is told')


def one_long_line(kbc, library, folder):
    def cost(separator):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        editor = begin(kbc, library)
        text = separator.join(['levels a > b'] + [f'fact F{i} satellite S{i} rule r{i} at a when F{i} and S{i} then +S{i}, -S{i + 1}' for i in range(1500)] + ['satellite S1500 # \U0001F916']) + '\n'
        uri = editor.open(folder / 'long.kb', text)
        editor.messages_of(uri)
        editor.of(uri, 'semanticTokens/full')
        editor.change(uri, text + 'fact')
        expect(len(editor.messages_of(uri)) == 1, 'of a long text all is told')
        expect(editor.leave() == 0, 'the server leaves when it is told')
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    lines, line = cost('\n'), cost(' ')
    expect(line < 4 * lines + 0.5, f'a text on one line costs as much as on many: {line:.2f} s, {lines:.2f} s')


CASES = (names_of_all_kinds, half_written, imports_that_come_and_go, importers_elsewhere, haste, one_long_line)
