"""Reads NetCDF files of the classic kinds (CDF-1, 2 and 5), with what Python brings along."""
import struct

SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}
DIMENSION, VARIABLE, ATTRIBUTE = 10, 11, 12


class _Reader:
    def __init__(self, data):
        self.data, self.at = data, 4
        kind = data[:4]
        if kind[:3] != b"CDF" or kind[3] not in (1, 2, 5):
            raise ValueError("no NetCDF file of the classic kind")
        self.count = ">Q" if kind[3] == 5 else ">I"
        self.offset = ">I" if kind[3] == 1 else ">Q"

    def number(self, form):
        value, = struct.unpack_from(form, self.data, self.at)
        self.at += struct.calcsize(form)
        return value

    def block(self, size):
        value = self.data[self.at:self.at + size]
        self.at += (size + 3) // 4 * 4
        return value

    def name(self):
        return self.block(self.number(self.count)).decode()

    def list(self, kind, entry):
        found, count = self.number(">I"), self.number(self.count)
        if found not in (0, kind) or (found == 0 and count):
            raise ValueError("damaged header")
        return [entry() for _ in range(count)]

    def attribute(self):
        name, kind = self.name(), self.number(">I")
        value = self.block(self.number(self.count) * SIZES[kind])
        return name, value.decode() if kind == 2 else value

    def variable(self, dimensions):
        name = self.name()
        along = [dimensions[self.number(self.count)] for _ in range(self.number(self.count))]
        self.list(ATTRIBUTE, self.attribute)
        kind = self.number(">I")
        self.number(self.count)
        begin = self.number(self.offset)
        size = SIZES[kind]
        for _, length in along:
            size *= length
        return name, self.data[begin:begin + size]


def read(path):
    """(dimensions, attributes, variables): lengths, texts and the raw bytes of values, by name."""
    with open(path, "rb") as file:
        reader = _Reader(file.read())
    reader.number(reader.count)
    dimensions = reader.list(DIMENSION, lambda: (reader.name(), reader.number(reader.count)))
    attributes = dict(reader.list(ATTRIBUTE, reader.attribute))
    variables = dict(reader.list(VARIABLE, lambda: reader.variable(dimensions)))
    return dict(dimensions), attributes, variables
