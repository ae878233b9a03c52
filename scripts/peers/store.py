"""Results as JSON lines, so that a run goes on where another stopped."""

import json


class Store:
    """What was measured, by what was asked; a line is added as soon as it is known."""

    def __init__(self, path):
        self.path = path
        self.known = {}
        text = path.read_text() if path.exists() else ""
        for line in text.splitlines():
            try:
                entry = json.loads(line)
                self.known[self.name(entry["key"])] = entry["value"]
            except (ValueError, KeyError):
                continue  # half a line, where a run was stopped
        if text and not text.endswith("\n"):
            with path.open("a") as file:
                file.write("\n")

    @staticmethod
    def name(key):
        return json.dumps(key, sort_keys=True)

    def get(self, key):
        return self.known.get(self.name(key))

    def put(self, key, value):
        self.known[self.name(key)] = value
        with self.path.open("a") as file:
            file.write(json.dumps({"key": key, "value": value}) + "\n")

    def forget(self, which):
        """Drops what was measured under keys for which `which` holds, in the file too."""
        self.known = {name: value for name, value in self.known.items() if not which(json.loads(name))}
        lines = [json.dumps({"key": json.loads(name), "value": value}) + "\n" for name, value in self.known.items()]
        self.path.write_text("".join(lines))
