"""The engine as a child process that speaks JSON lines: one process, many requests.

    with Client(find_engine()) as client:
        scene = client.ask("load", scene="/tmp/job/scene.rad")
        number = client.send("render", view="main", size=[640, 400], accuracy=0.05, file="/tmp/job/main.exr")
        for event in client.events(number):    # progress, partial; the last one is the result
            ...

Nothing here waits longer than it is told; the reading happens in a thread.
"""

import collections
import json
import queue
import subprocess
import threading
import time

from .engine import SECONDS_TO_GREET, EngineError, check_hello

FINAL = ("result", "error", "cancelled")
# An engine that was asked to stop and does not is ended.
SECONDS_TO_STOP = 2.0
# The same when nobody waits for the end of what was stopped but a later request.
SECONDS_LEFT_ALONE = 10.0
_LINES_OF_COMPLAINT = 20


class Client:
    """@throws EngineError when the program does not start, or does not greet in time"""

    def __init__(self, path, seconds=SECONDS_TO_GREET):
        self.path, self._queue, self._number = path, queue.Queue(), 0
        self._waiting, self._lock = {}, threading.Lock()
        self._left = {}  # requests that nobody waits for any more: when they were told to stop
        self._complaints = collections.deque(maxlen=_LINES_OF_COMPLAINT)
        self.listener = None  # called, without arguments, in the reading thread when something has come
        try:
            self._process = subprocess.Popen([str(path), "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                             stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace",
                                             bufsize=1)
        except OSError as error:
            raise EngineError(f"{path} does not start: {error}") from error
        self._threads = [threading.Thread(target=target, daemon=True) for target in (self._read, self._read_complaints)]
        for thread in self._threads:
            thread.start()
        try:
            entry = self._queue.get(timeout=seconds)
            if entry is None:
                raise EngineError(self._death())
            self.hello = check_hello(entry[0], path)
        except queue.Empty:
            self.close()
            raise EngineError(f"{path} does not greet within {seconds:g} s") from None
        except EngineError:
            self.close()
            raise

    # --- asking

    def send(self, do, **fields):
        """Queues a request; returns its number.

        @throws EngineError when the engine is gone
        """
        with self._lock:
            self._number += 1
            number = self._number
        self._waiting[number] = collections.deque()
        self._write({"id": number, "do": do, **fields})
        return number

    def cancel(self, number):
        """Asks for the end of a request; its last event is then `cancelled`, or what it had already become."""
        with self._lock:
            self._number += 1
        self._write({"id": self._number, "do": "cancel", "target": number})

    def next_event(self, number, timeout=0.0):
        """The next event of a request, or None when nothing has come in that time. `arrived`: time.monotonic() then.

        @throws EngineError when the engine is gone
        """
        end = time.monotonic() + timeout
        while True:
            self._sort()
            events = self._waiting.get(number)
            if events:
                event = events.popleft()
                if event["event"] in FINAL:
                    del self._waiting[number]
                return event
            left = end - time.monotonic()
            if left <= 0:
                return None
            try:
                self._take(self._queue.get(timeout=left))
            except queue.Empty:
                return None

    def events(self, number, stop=lambda: False, poll=0.02, leave=False):
        """All events of a request, up to the last one; `stop()` true cancels it once.

        leave  whether a cancelled request is left at once, with `cancelled` as its last event: the engine's own last
               word is heard with later requests
        @throws EngineError when the engine is gone, or goes on for SECONDS_TO_STOP after it was told to stop,
                SECONDS_LEFT_ALONE after a request was left
        """
        stopping = None
        while True:
            if stopping is None and stop():
                self.cancel(number)
                stopping = time.monotonic()
                if leave:
                    events = self._waiting.pop(number)
                    if not (events and events[-1]["event"] in FINAL):
                        self._left[number] = stopping
                    yield {"event": "cancelled", "id": number}
                    return
            event = self.next_event(number, poll)
            if event is not None:
                yield event
                if event["event"] in FINAL:
                    return
            else:
                if stopping is not None:
                    self._end_if_deaf(stopping, SECONDS_TO_STOP)
                if self._left:
                    self._end_if_deaf(min(self._left.values()), SECONDS_LEFT_ALONE)

    def ask(self, do, stop=lambda: False, leave=False, **fields):
        """The result of a request that is waited for.

        @throws EngineError with the engine's sentence
        """
        for event in self.events(self.send(do, **fields), stop, leave=leave):
            pass
        if event["event"] == "error":
            raise EngineError(sentence_of(event))
        if event["event"] == "cancelled":
            raise EngineError(f"{do} was stopped")
        return event

    # --- the process

    def alive(self):
        return self._process.poll() is None

    def close(self):
        """Ends the engine; it keeps nothing half written."""
        if self._process.poll() is None:
            try:
                self._process.stdin.close()
            except OSError:
                pass
            try:
                self._process.wait(SECONDS_TO_STOP)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        for thread in self._threads:
            thread.join(SECONDS_TO_STOP)
        for pipe in (self._process.stdin, self._process.stdout, self._process.stderr):
            try:
                pipe.close()
            except OSError:
                pass  # what was still to be written finds no reader

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _write(self, request):
        try:
            self._process.stdin.write(json.dumps(request) + "\n")
            self._process.stdin.flush()
        except (OSError, ValueError) as error:
            raise EngineError(self._death()) from error

    def _read(self):
        try:
            for line in self._process.stdout:
                self._queue.put((line, time.monotonic()))
                if self.listener is not None:
                    self.listener()
        except ValueError:
            pass  # closed while waiting
        self._queue.put(None)
        if self.listener is not None:
            self.listener()

    def _read_complaints(self):
        try:
            for line in self._process.stderr:
                self._complaints.append(line.rstrip())
        except ValueError:
            pass

    def _end_if_deaf(self, told, patience):
        """`told`: when a request that has not ended was told to stop."""
        if time.monotonic() - told > patience:
            self.close()
            raise EngineError(f"the engine did not stop within {patience:g} s and was ended")

    def _sort(self):
        while True:
            try:
                self._take(self._queue.get_nowait())
            except queue.Empty:
                return

    def _take(self, entry):
        if entry is None:
            self._queue.put(None)  # the next one who asks shall know too
            raise EngineError(self._death())
        line, arrived = entry
        try:
            event = json.loads(line)
            if event.get("event") in FINAL:
                self._left.pop(event.get("id"), None)
            events = self._waiting.get(event.get("id"))
            if events is not None and isinstance(event.get("event"), str):
                events.append(dict(event, arrived=arrived))
        except (ValueError, AttributeError):
            self._complaints.append(line.rstrip()[:200])

    def _death(self):
        try:
            status = self._process.wait(1.0)
        except subprocess.TimeoutExpired:
            status = None
        self._threads[1].join(0.5)
        said = "; ".join(self._complaints)[-400:]
        how = "still runs but does not listen" if status is None else \
            f"was ended by signal {-status}" if status < 0 else f"ended with status {status}"
        return f"the Lightwell engine {how}" + (f"; it said: {said}" if said else "") + ". The next start tries again"


def sentence_of(event):
    """An error event as one sentence: what it is about, what is wrong, the way out."""
    text = str(event.get("text", "the engine gives no reason"))
    about = [f"{what} \"{event[what]}\"" for what in ("object", "layer") if event.get(what)]
    place = f"{event['file']}:{event['line']}: " if event.get("file") and event.get("line") else ""
    way_out = f" ({event['way_out']})" if event.get("way_out") else ""
    return place + (", ".join(about) + ": " if about else "") + text + way_out
