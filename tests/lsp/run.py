#!/usr/bin/env python3
"""`kbc lsp` as an editor meets it.

  run.py KBC LIBRARY
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import renaming
import writing
from editor import Editor, codes, cut, expect

KBC, LIBRARY = sys.argv[1:]

BASE = '''# Which way the robot can look.
names Side { left, right }
# A wall is near.
#
# From the two whiskers.
facts Wall[Side]
'''
MAIN = '''import "base.kb"
levels think > choose > act
strategies Drive { ahead, back }
satellite Halted
rule halt at think when any Wall and sat Drive.ahead then +Halted, -sat Drive.ahead
rule back at choose when Halted then +sat Drive.back
rule ahead at choose when lost Wall.left then +sat Drive.ahead
'''


def files(folder):
    base, main = folder / 'base.kb', folder / 'robot.kb'
    base.write_text(BASE)
    main.write_text(MAIN)
    return base, main


def messages_while_typing(editor, folder):
    base, main = files(folder)
    uri = editor.open(main)
    expect(codes(editor.messages_of(uri)) == [], 'a sound file has no messages')
    editor.change(uri, wrong := MAIN.replace('any Wall', 'any Wal'))
    [message] = editor.messages_of(uri)
    expect(message['code'] == 'KB0401' and cut(wrong, message['range']) == 'Wal' and 'did you mean `Wall`?' in message['message'], 'an unknown name is underlined')
    [fix] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message]})
    [edit] = fix['edit']['changes'][uri]
    expect(edit['newText'] == 'Wall' and edit['range'] == message['range'] and fix['diagnostics'] == [message], 'what was meant is a quick fix')
    editor.change(uri, wrong + 'rule next at think when')
    [other, again] = editor.messages_of(uri)
    expect(other['code'] == 'KB0201' and again == message, 'and stays so while another statement is being written')
    editor.change(uri, MAIN)
    expect(editor.messages_of(uri) == [], 'a mended file has no messages')
    editor.change(uri, wrong := MAIN.replace('satellite Halted', 'satellite Halted\nsatellite Halted'))
    [message] = editor.messages_of(uri)
    expect([cut(wrong, note['location']['range']) for note in message['relatedInformation']] == ['Halted'], 'where it was declared first is told with its place')
    for written, meant in (('"std.road"', 'std.road'), ('"bas.kb"', '"base.kb"')):
        editor.change(uri, wrong := MAIN.replace('"base.kb"', written))
        message = next(message for message in editor.messages_of(uri) if message['code'] == 'KB0902')
        [fix] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message]})
        [edit] = fix['edit']['changes'][uri]
        expect(cut(wrong, edit['range']) == written and edit['newText'] == meant, f'an import of {written} is mended to {meant}')
    control = 'control Drive.ahead = follow_line(speed: 0.3 m/s)\ncontrol Drive.back = '
    for written, meant, line in (('folow_line', 'follow_line', 'folow_line(speed: 0.2 m/s)'), ('sped', 'speed', 'keep_wall(sped: 0.2 m/s)'),
                                 ('sped', 'speed', 'drive(sped: 1)\nstrategy Roll\ncontrol Roll = drive(speed: 1)\nstrategy Run\ncontrol Run = drive(speed: 1)'),
                                 ('leftt', 'left', 'drive(side: leftt)')):
        editor.change(uri, wrong := MAIN + control + line + '\n')
        message = next(message for message in editor.messages_of(uri) if message['message'].endswith(f'did you mean `{meant}`?'))
        [fix, *_] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message]})
        [edit] = fix['edit']['changes'][uri]
        expect(cut(wrong, edit['range']) == written and edit['newText'] == meant, f'`{written}` in a control line is mended to `{meant}`, as `kbc check` has it')
    editor.change(uri, text := 'levels a > b\nfact C, D\nsatellite S output\nrule r at a\n    when C\n    then +S\nrule q at a\n    when D\n    then -S\nrule e at b when C then +S\n')
    [message] = editor.messages_of(uri)
    [fix] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message]})
    expect(fix['edit']['changes'][uri] == [{'range': {'start': {'line': 6, 'character': 0}, 'end': {'line': 6, 'character': 0}}, 'newText': '# allow: conflicting-rules\n'}], 'a warning can be allowed above its statement')
    editor.change(uri, text.replace('rule q', '# allow: conflicting-rules\nrule q'))
    expect(editor.messages_of(uri) == [], 'and is no longer there')
    editor.change(uri, wrong := 'import std.navigation\nmap turn_of {\n    landmark Inn at (0, 0)\n}\n')
    [message] = editor.messages_of(uri)
    expect(message['code'] == 'KB0301' and cut(wrong, message['range']) == 'turn_of', 'a name of the library is told where it is given again')
    [library] = [uri for uri in editor.messages if uri.endswith('/std/crossing.kb')]
    expect(codes(editor.messages[library]) == ['KB0409'], 'what the library can no longer do is told as well')
    for letters in range(len(MAIN)):   # as somebody writes it who types faster than compilers compile
        editor.change(uri, MAIN[:letters])
    editor.change(uri, MAIN)
    expect(editor.messages_of(uri) == [], 'typed letter by letter it ends without messages')


def a_part_is_judged_with_the_whole(editor, folder):
    base, main = files(folder)
    uri = editor.open(base)
    expect(editor.messages_of(uri) == [], 'an imported file that says nothing of levels has no messages')
    editor.change(uri, BASE.replace('Side {', 'Sides {'))
    messages = editor.messages_of(uri)
    expect(len(messages) == 1 and cut(BASE, messages[0]['range']) == 'Side', 'its own mistake is told')
    editor.change(uri, BASE.replace('facts Wall[Side]', 'facts Whisker[Side]'))
    editor.messages_of(uri)
    expect('KB0401' in codes(editor.messages[main.as_uri()]), 'what it breaks in a file that is not open is told there')
    editor.told.clear()
    editor.change(uri, BASE.replace('facts Wall[Side]', 'facts Whisker[Side]   # the same again'))
    editor.messages_of(uri)
    expect(main.as_uri() not in [told['uri'] for told in editor.told], 'a file about which nothing else is to be said is not told of again')
    editor.tell('textDocument/didClose', {'textDocument': {'uri': uri}})
    editor.ask_whole('textDocument/hover', {'textDocument': {'uri': uri}, 'position': {'line': 0, 'character': 0}})
    expect(not editor.messages[main.as_uri()] and not editor.messages[uri], 'when it is closed unsaved, nothing is wrong any more')


def files_that_change_outside(folder):
    base, main = files(folder)
    editor = Editor(KBC, '--library', LIBRARY, '-Wno-never-read', '-Wno-no-controller')
    editor.begin(workspace={'didChangeWatchedFiles': {'dynamicRegistration': True}})
    request = editor.receive()
    expect(request['method'] == 'client/registerCapability' and request['params']['registrations'][0]['registerOptions']['watchers'] == [{'globPattern': '**/*.kb'}], 'the server asks to be told of files')
    editor.send(id=request['id'], result=None)
    uri = editor.open(main)
    expect(editor.messages_of(uri) == [], 'all is well at first')
    base.write_text(BASE.replace('Wall', 'Whisker'))
    editor.tell('workspace/didChangeWatchedFiles', {'changes': [{'uri': base.as_uri(), 'type': 2}]})
    expect('KB0401' in codes(editor.messages_of(uri)), 'what is changed by others is seen')
    expect(editor.leave() == 0, 'the server leaves when it is told')


def questions(editor, folder):
    base, main = files(folder)
    uri = editor.open(main)
    hover = editor.of(uri, 'hover', MAIN, 'Wall and')
    text = hover['contents']['value']
    expect('fact `Wall` `[Side]`' in text and 'A wall is near.\n\nFrom the two whiskers.' in text and 'base.kb:6:7' in text, 'a name is explained, with the comment above its declaration')
    expect(cut(MAIN, hover['range']) == 'Wall', 'and the editor knows which')
    [place] = editor.of(uri, 'definition', MAIN, 'Wall and')
    expect(place['uri'] == base.as_uri() and cut(BASE, place['range']) == 'Wall', 'it leads to its declaration in another file')
    [place] = editor.of(uri, 'definition', MAIN, 'back\n')
    expect(cut(MAIN, place['range']) == 'back' and place['range']['start']['line'] == 2, 'a member leads to where it is declared, not to a rule that is called alike')
    expect(editor.of(uri, 'definition', MAIN, '"base')['uri'] == base.as_uri(), 'an import leads to its file')
    expect(editor.of(uri, 'hover', MAIN, 'when') is None, 'a word of the language is no name')
    places = editor.of(uri, 'references', MAIN, 'Halted', context={'includeDeclaration': True})
    expect([cut(MAIN, place['range']) for place in places] == ['Halted'] * 3, 'all places of a name are found')
    uses = editor.of(uri, 'references', MAIN, 'Halted', context={'includeDeclaration': False})
    expect(uses == places[1:], 'or all but the declaration, as the editor wants')
    indented = MAIN.replace('satellite Halted', '  # It stands.\n\t# Still.\n  satellite Halted')
    editor.change(uri, indented)
    hover = editor.of(uri, 'hover', indented, 'Halted')
    expect('It stands.\nStill.' in hover['contents']['value'], 'a comment may be indented')
    table = MAIN + 'table other(Side) -> Side { left: right  right: left }\n'
    editor.change(uri, table)
    hover = editor.of(uri, 'hover', table, 'other')
    expect('table `other` `(Side) -> Side`' in hover['contents']['value'], 'a table is a name as well')
    editor.change(uri, indented)
    symbols = editor.of(uri, 'documentSymbol')
    expect([symbol['name'] for symbol in symbols] == ['think', 'choose', 'act', 'Drive', 'Halted', 'halt', 'back', 'ahead'], 'the outline has what the file declares, in its order')
    expect(symbols[3]['detail'] == 'strategy { ahead, back }', 'with what belongs to it')


def completion(editor, folder):
    base, main = files(folder)
    uri = editor.open(main)
    labels = [item['label'] for item in editor.of(uri, 'completion', MAIN, 'alted then')]
    expect({'Wall', 'Drive', 'Halted', 'seen', 'any'} <= set(labels) and not {'halt', 'think', 'rule'} & set(labels), 'names and words are offered that can stand there')
    typing = MAIN + 'rule more at choose when Halted then +sat Drive.'
    editor.change(uri, typing)
    at = {'line': 7, 'character': len('rule more at choose when Halted then +sat Drive.')}
    items = editor.of(uri, 'completion', position=at)
    expect([item['label'] for item in items] == ['ahead', 'back'], 'behind a dot its members, though the file cannot be read as it is')
    editor.change(uri, 'import std.na\n' + MAIN)
    items = editor.of(uri, 'completion', position={'line': 0, 'character': 13})
    [item] = [item for item in items if item['label'] == 'std.navigation']
    expect(item['textEdit']['range'] == {'start': {'line': 0, 'character': 7}, 'end': {'line': 0, 'character': 13}}, 'behind `import` the files of the library')


    editor.change(uri, town := 'import std.navigation\nmap Town {\n    landmark Dock at (0, 0)\n    landmark Inn at (1, 0)\n    road Dock.E -- Inn.W\n}\nrule r at goal when Dock then reset\n')
    labels = [item['label'] for item in editor.of(uri, 'completion', town, 'Dock then')]
    expect('Dock' in labels and all(label.isidentifier() for label in labels), 'nothing is offered that cannot be written, such as the name of a road')
    for more, road, exits in (('', '', ['N', 'E', 'S', 'W']), ('names Gate { quay, yard }\n', '    road Inn.quay -- Dock.yard\n', ['quay', 'yard'])):
        town = f'import std.navigation\n{more}map Town {{\n    landmark Dock\n    landmark Inn\n{road}'
        editor.change(uri, town + '}\n')
        editor.messages_of(uri)
        for line in ('    road Dock.', '    road New.'):
            editor.change(uri, town + line)
            items = editor.of(uri, 'completion', position={'line': town.count('\n'), 'character': len(line)})
            expect([item['label'] for item in items] == exits, f'behind `{line.strip()}` exits: {exits}')


def names_of_open_files(editor, folder):
    real, link = folder / 'real', folder / 'link'
    real.mkdir()
    link.symlink_to(real)
    files(real)
    for name in ('robot.kb', 'a(b)!.kb'):
        path = link / name
        path.write_text(wrong := MAIN.replace('any Wall', 'any Wal'))
        uri = path.as_uri().replace('%28', '(').replace('%29', ')').replace('%21', '!')
        editor.tell('textDocument/didOpen', {'textDocument': {'uri': uri, 'languageId': 'kb', 'version': 1, 'text': wrong}})
        [message] = editor.messages_of(uri)
        [fix] = editor.of(uri, 'codeAction', range=message['range'], context={'diagnostics': [message]})
        expect(list(fix['edit']['changes']) == [uri], f'a quick fix is for the file that is open, {name}')
        [place] = editor.of(uri, 'definition', MAIN.replace('any Wall', 'any Wal'), 'Halted')
        expect(place['uri'] == uri, 'so is where a name is declared')
        expect({place['uri'] for place in editor.of(uri, 'references', wrong, 'Halted', context={'includeDeclaration': True})} == {uri}, 'and where it stands')
        editor.tell('textDocument/didClose', {'textDocument': {'uri': uri}})


def layout_and_colours(editor, folder, legend):
    _, main = files(folder)
    uri = editor.open(main)
    [edit] = editor.of(uri, 'formatting', options={'tabSize': 2, 'insertSpaces': True})
    laid_out = subprocess.run([KBC, 'fmt', str(main)], capture_output=True, text=True, check=True).stdout
    first, last = edit['range']['start'], edit['range']['end']
    lines = MAIN.splitlines(keepends=True)
    expect(first['character'] == last['character'] == 0 and ''.join(lines[:first['line']]) + edit['newText'] + ''.join(lines[last['line']:]) == laid_out, 'the layout is that of `kbc fmt`')
    expect(first['line'] == 3, 'lines before it that stay are left alone')
    editor.change(uri, laid_out.replace('satellite  Halted', 'satellite Halted'))
    [edit] = editor.of(uri, 'formatting', options={})
    expect(edit == {'range': {'start': {'line': 3, 'character': 0}, 'end': {'line': 4, 'character': 0}}, 'newText': 'satellite  Halted\n'}, 'and those behind it')
    editor.change(uri, laid_out)
    expect(editor.of(uri, 'formatting', options={}) == [], 'what is laid out stays')
    editor.change(uri, MAIN + 'rule')
    expect(editor.of(uri, 'formatting', options={}) is None, 'what cannot be read is left as it is')
    text = 'levels map > act  # ü\U0001F916\nfact Wall\nsatellite Far\nrule go at map when Wall then +Far\n'
    editor.change(uri, text)
    data = editor.of(uri, 'semanticTokens/full')['data']
    lines, found, line, character = text.split('\n'), [], 0, 0
    for i in range(0, len(data), 5):
        line, character = (line + data[i], data[i + 1]) if data[i] else (line, character + data[i + 1])
        found.append((cut(text, {'start': {'line': line, 'character': character}, 'end': {'line': line, 'character': character + data[i + 2]}}), legend[data[i + 3]]))
    expect(('# ü\U0001F916', 'comment') in found and ('Wall', 'variable') in found and ('when', 'keyword') in found and ('act', 'namespace') in found, 'words, names and comments are told apart')
    editor.change(uri, text := text.replace('when Wall', 'when Wall != Far'))
    data = editor.of(uri, 'semanticTokens/full')['data']
    expect(all(data[i] or data[i + 1] for i in range(5, len(data), 5)), 'nothing is coloured twice')
    expect([kind for word, kind in found if word == 'map'] == ['namespace', 'namespace'], 'a word that is used as a name is coloured as one')


def bytes_and_units(folder):
    _, main = files(folder)
    text = '# \U0001F916\nlevels a\nrule \u00fcber at a when Wal then reset  # \u00fc\n'
    for encoding, column in (('utf-16', 20), ('utf-8', 21)):
        editor = Editor(KBC, '--library', LIBRARY)
        result = editor.begin(general={'positionEncodings': [encoding]})
        uri = editor.open(folder / 'other.kb', text)
        starts = [message['range']['start'] for message in editor.messages_of(uri)]
        expect(result['capabilities']['positionEncoding'] == encoding and {'line': 2, 'character': column} in starts, f'columns are counted in {encoding}')
        expect(editor.leave() == 0, 'the server leaves when it is told')


def what_editors_should_not_do(folder):
    _, main = files(folder)
    editor = Editor(KBC, '--library', LIBRARY, '--stdio')
    expect(editor.ask_whole('textDocument/hover', {})['error']['code'] == -32002, 'a question before `initialize` is refused')
    editor.begin()
    expect(editor.ask_whole('textDocument/moniker', {})['error']['code'] == -32601, 'an unknown method is refused')
    expect(editor.ask_whole('textDocument/hover', {'position': 3})['error']['code'] == -32602, 'wrong parameters are refused')
    uri = editor.open(main)
    expect(editor.ask_whole('textDocument/hover', {'textDocument': {'uri': uri}, 'position': {'line': 'a', 'character': 0}})['error']['code'] == -32602, 'a line that is no number is refused')
    expect(editor.of(uri, 'hover', position={'line': 2**31 - 1, 'character': 2**31 - 1}) is None, 'a place behind the end is no name')
    for number in (-1, 0.5, 1e300, 2**31, 2**64, 2**70, None, [], True):
        for place in ({'line': number, 'character': 0}, {'line': 0, 'character': number}):
            expect(editor.ask_whole('textDocument/hover', {'textDocument': {'uri': uri}, 'position': place})['error']['code'] == -32602, f'{place} is no place')
    expect(editor.of('untitled:Untitled-1', 'hover', position={'line': 0, 'character': 0}) is None, 'of a file that is not there nothing is said')
    editor.tell('textDocument/didChange', {'textDocument': {'uri': 'file:///nowhere.kb'}, 'contentChanges': [{'text': 'x'}]})
    here = {'line': 0, 'character': 0}
    editor.tell('textDocument/didChange', {'textDocument': {'uri': uri, 'version': 2}, 'contentChanges': [{'range': {'start': here, 'end': here}, 'text': ''}]})
    expect(editor.of(uri, 'documentSymbol') != [], 'a change of a part, which was not asked for, leaves the document as it was')
    for wrong in ({'id': 1}, {'id': [1]}, {}, [1], 1, None):
        editor.tell('$/cancelRequest', wrong)
    editor.send_bytes(b'{"jsonrpc":')
    expect(editor.receive()['error']['code'] == -32700, 'what is no JSON is refused')
    for deep in (b'{"jsonrpc": "2.0", "id": %s, "method": "x"}', b'{"jsonrpc": "2.0", "id": 1, "method": "x", "params": %s}'):
        editor.send_bytes(deep % (b'[' * 200_000 + b']' * 200_000))
        expect(editor.receive()['error']['code'] == -32700, 'what is nested too deep is refused')
    editor.send_bytes(b'[1, 2]')
    expect(editor.receive()['error']['code'] == -32600, 'what is no message is refused')
    editor.open(main, 'levels a\nfact \u0000\ud7ff\n')
    expect(codes(editor.messages_of(uri)) != [], 'odd characters are messages')
    for half in ('\ud83d', '\ude00', '\ud83d\ud83d\ude00', '\ude00\ud83d', '\\ud83d\ud83d'):
        editor.change(uri, f'levels a > b\nfact Seen_{len(half)}   # {half}')
        [symbol] = [one for one in editor.of(uri, 'documentSymbol') if one['name'].startswith('Seen')]
        expect(symbol['name'] == f'Seen_{len(half)}', 'half of a surrogate pair in a text is a character')
    expect(editor.leave() == 0, 'and after all that it goes on as before')

    for stream, what in ((b'', 'a stream that ends'), (b'Content-Length: 10\r\n\r\n{}', 'a message that is cut off'), (b'Hello\r\n\r\n{}', 'a header without a length'),
                         (b'Content-Length: 99999999999999999999\r\n\r\n', 'a length that is none'), (b'Content-Length: 9999999999\r\n\r\n', 'a length that nobody sends'), (b'x' * 10_000, 'a header without an end')):
        done = subprocess.run([KBC, 'lsp'], input=stream, capture_output=True, timeout=60)
        expect(done.returncode == 1 and done.stdout == b'', f'{what} ends the server with 1')


def an_end_without_exit(folder):
    document = {'uri': (folder / 'robot.kb').as_uri(), 'languageId': 'kb', 'version': 1, 'text': 'levels a\nrule r at a when Wal then reset\n'}
    told = ({'id': 1, 'method': 'initialize', 'params': {'processId': None, 'rootUri': None, 'capabilities': {}}}, {'method': 'textDocument/didOpen', 'params': {'textDocument': document}})
    bodies = [json.dumps({'jsonrpc': '2.0', **message}).encode() for message in told]
    done = subprocess.run([KBC, 'lsp', '--library', LIBRARY], input=b''.join(b'Content-Length: %d\r\n\r\n' % len(body) + body for body in bodies), capture_output=True, timeout=60)
    expect(done.returncode == 1 and b'"uri":"' + document['uri'].encode() in done.stdout and b'KB0401' in done.stdout, 'who ends the stream after a text is told what is wrong with it')


def main():
    for case in (messages_while_typing, a_part_is_judged_with_the_whole, questions, completion, names_of_open_files, layout_and_colours):
        with tempfile.TemporaryDirectory() as folder:
            editor = Editor(KBC, '--library', LIBRARY, '-Wno-never-read', '-Wno-no-controller')
            result = editor.begin()
            more = [result['capabilities']['semanticTokensProvider']['legend']['tokenTypes']] if case is layout_and_colours else []
            case(editor, pathlib.Path(folder).resolve(), *more)
            expect(editor.leave() == 0 and editor.process.stderr.read() == b'', f'{case.__name__}: the server leaves in silence')
    for case in (files_that_change_outside, bytes_and_units, what_editors_should_not_do, an_end_without_exit):
        with tempfile.TemporaryDirectory() as folder:
            case(pathlib.Path(folder).resolve())
    for case in renaming.CASES + writing.CASES:
        with tempfile.TemporaryDirectory() as folder:
            case(KBC, LIBRARY, pathlib.Path(folder).resolve())


if __name__ == '__main__':
    main()
