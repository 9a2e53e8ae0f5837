"""An editor without a window: starts `kbc lsp` and speaks its protocol."""
import json
import subprocess


def expect(holds, what):
    if not holds:
        raise SystemExit(f'FAIL: {what}')
    print('ok:', what)


def cut(text, place):
    lines = text.split('\n')
    begin, end = place['start'], place['end']
    assert begin['line'] == end['line']
    units = lines[begin['line']].encode('utf-16-le')
    return units[2 * begin['character']:2 * end['character']].decode('utf-16-le')


def place(text, at):
    """The first place of these words, their second letter."""
    before = text[:text.index(at) + 1]
    return {'line': before.count('\n'), 'character': len(before.rsplit('\n', 1)[-1].encode('utf-16-le')) // 2}


def codes(messages):
    return [message.get('code') for message in messages]


class Editor:
    def __init__(self, kbc, *options):
        self.process = subprocess.Popen([kbc, 'lsp', *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.asked = 0
        self.messages = {}   # by URI: what was published last
        self.told = []       # all that was published, in order

    def send_bytes(self, body):
        self.process.stdin.write(b'Content-Length: %d\r\n\r\n' % len(body) + body)
        self.process.stdin.flush()

    def send(self, **message):
        self.send_bytes(json.dumps({'jsonrpc': '2.0', **message}).encode())

    def receive(self):
        length = None
        while line := self.process.stdout.readline().strip():
            key, value = line.split(b':')
            if key.lower() == b'content-length':
                length = int(value)
        message = json.loads(self.process.stdout.read(length))
        if message.get('method') == 'textDocument/publishDiagnostics':
            self.messages[message['params']['uri']] = message['params']['diagnostics']
            self.told.append(message['params'])
        return message

    def ask_whole(self, method, params):
        """The whole answer, errors included."""
        self.asked += 1
        self.send(id=self.asked, method=method, params=params)
        while (message := self.receive()).get('id') != self.asked:
            pass
        return message

    def ask(self, method, params):
        answer = self.ask_whole(method, params)
        if 'error' in answer:
            raise SystemExit(f'FAIL: {method}: {answer["error"]}')
        return answer['result']

    def tell(self, method, params):
        self.send(method=method, params=params)

    # ---- what editors do

    def begin(self, parameters={}, **capabilities):
        result = self.ask('initialize', {'processId': None, 'rootUri': None, 'capabilities': capabilities, **parameters})
        self.tell('initialized', {})
        return result

    def open(self, path, text=None):
        uri = path.as_uri()
        self.tell('textDocument/didOpen', {'textDocument': {'uri': uri, 'languageId': 'kb', 'version': 1, 'text': path.read_text() if text is None else text}})
        return uri

    def change(self, uri, text):
        self.tell('textDocument/didChange', {'textDocument': {'uri': uri, 'version': 2}, 'contentChanges': [{'text': text}]})

    def of(self, uri, method, text=None, at=None, **params):
        """Asks of a file; `at`: as `place` takes it."""
        if at is not None:
            params['position'] = place(text, at)
        return self.ask('textDocument/' + method, {'textDocument': {'uri': uri}, **params})

    def messages_of(self, uri):
        """What is published of the file, once all that was told before has been seen to."""
        self.of(uri, 'documentSymbol')
        return self.messages.get(uri, [])

    def leave(self):
        self.ask('shutdown', None)
        self.tell('exit', None)
        return self.process.wait(timeout=60)
