"""Names of the host as words of the scene language, and back."""

_KEPT_BY_THE_LANGUAGE = {"void", "inherit"}


def encoded(name):
    """One word that reads back as `name`, whatever characters it has."""
    if not name:
        return "%00"
    word = "".join("%%%02X" % ord(c) if ord(c) <= 0x20 or ord(c) == 0x7F or c in "%#" else c for c in name)
    if word in _KEPT_BY_THE_LANGUAGE or word[0] in "!\"'":
        word = "%%%02X" % ord(word[0]) + word[1:]
    return word


def decoded(word):
    """The name behind such a word."""
    data, result, i = word.encode("utf-8", "surrogatepass"), bytearray(), 0
    while i < len(data):
        pair = data[i + 1:i + 3]
        if data[i:i + 1] == b"%" and len(pair) == 2 and all(c in b"0123456789abcdefABCDEF" for c in pair):
            if int(pair, 16):
                result.append(int(pair, 16))
            i += 3
        else:
            result.append(data[i])
            i += 1
    return result.decode("utf-8", "replace")


class UniqueNames:
    """Gives each key one name; a second key that wants the same name gets `name (2)`."""

    def __init__(self):
        self._names, self._taken = {}, set()

    def of(self, key, wanted):
        if key not in self._names:
            name, number = wanted, 1
            while name in self._taken:
                number += 1
                name = f"{wanted} ({number})"
            self._taken.add(name)
            self._names[key] = name
        return self._names[key]
