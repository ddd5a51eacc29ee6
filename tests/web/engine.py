"""The browser's engine, asked from Python."""
import json
import os
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))


class EngineError(Exception):
    """What an engine answers instead of a result; `parts` as protocol.ts has them."""

    def __init__(self, parts):
        super().__init__(parts["message"])
        self.parts = parts


class Engine:
    """One module under Node.js. Arrays for calls that take them: {"f64": [...]} or {"i32": [...]}."""

    def __init__(self, node, folder):
        door = os.path.join(HERE, "..", "..", "web", "src", "engine", "module.mjs")
        self._process = subprocess.Popen(
            [node, "--no-experimental-fetch", os.path.join(HERE, "engine.mjs"), folder, door],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.seconds = 0.0  # of the last call

    def call(self, name, *arguments):
        self._process.stdin.write(json.dumps([name, *arguments]) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"the engine ended at {name}: exit {self._process.wait()}")
        answer = json.loads(line)
        self.seconds = answer["seconds"]
        if "error" in answer:
            raise EngineError(answer["error"])
        return answer["result"]

    def close(self):
        self._process.stdin.close()
        self._process.wait()
        self._process.stdout.close()
