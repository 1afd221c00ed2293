# Writes Photoshop files of all kinds, for tests that read them.
import struct
import zlib

import numpy

GRAY, INDEXED, RGB, CMYK, DUOTONE, LAB = 1, 2, 3, 4, 8, 9
COLORS = {GRAY: 1, INDEXED: 1, RGB: 3, CMYK: 4, DUOTONE: 1, LAB: 3}
NONE, RUNS, ZIP, ZIP_DIFFERENCES = range(4)


def run_lengths(row):
    """PackBits without any effort: runs of one byte, or literals."""
    out, at = b"", 0
    while at < len(row):
        run = 1
        while at + run < len(row) and run < 128 and row[at + run] == row[at]:
            run += 1
        out += bytes([257 - run, row[at]]) if run > 1 else bytes([0, row[at]])
        at += run
    return out


def stored(plane, depth, packing):
    """The compression and the bytes of a channel; of run lengths, the lengths apart from the rows."""
    samples = plane.astype(">u2" if depth == 16 else "u1")
    if packing == RUNS:
        rows = [run_lengths(row.tobytes()) for row in samples]
        return b"".join(struct.pack(">H", len(row)) for row in rows), b"".join(rows)
    if packing == ZIP_DIFFERENCES:
        before = numpy.concatenate([numpy.zeros_like(plane[:, :1]), plane[:, :-1]], axis=1)
        samples = ((plane.astype(int) - before) % (1 << depth)).astype(samples.dtype)
    data = samples.tobytes()
    return b"", zlib.compress(data) if packing >= ZIP else data


def block(key, data):
    return b"8BIM" + key + struct.pack(">I", len(data)) + data + b"\0" * (-len(data) % 4)


def layer_info(layers, depth, packing):
    """`layers`: name, left, top, and the planes: the alpha, and then the colors; possibly an id."""
    records, channels = b"", b""
    for name, left, top, planes, *ident in layers:
        height, width = planes[0].shape
        records += struct.pack(">iiiiH", top, left, top + height, left + width, len(planes))
        for number, plane in enumerate(planes):
            data = struct.pack(">H", packing) + b"".join(stored(plane, depth, packing))
            records += struct.pack(">hI", number - 1, len(data))
            channels += data
        pascal = bytes([len(name)]) + name.encode()
        extra = struct.pack(">II", 0, 0) + pascal + b"\0" * (-len(pascal) % 4)
        extra += b"".join(block(b"lyid", struct.pack(">I", number)) for number in ident)
        records += b"8BIMnorm" + struct.pack(">BBBBI", 255, 0, 0, 0, len(extra)) + extra
    info = struct.pack(">h", len(layers)) + records + channels
    return info + b"\0" * (len(info) % 2)


def psd(width, height, mode, depth, packing, merged, layers=(), palette=b"", transparent=None):
    resources = b"" if transparent is None else b"8BIM" + struct.pack(">HHIH", 1047, 0, 2, transparent)
    section = b""
    if layers:
        info = layer_info(layers, depth, packing)
        section = (struct.pack(">II", 0, 0) + block(b"Lr16", info) if depth == 16
                   else struct.pack(">I", len(info)) + info + struct.pack(">I", 0))
    parts = [stored(plane, depth, packing) for plane in merged]
    data = b"".join(lengths for lengths, _ in parts) + b"".join(rows for _, rows in parts)
    return (b"8BPS" + struct.pack(">H6xHIIHH", 1, len(merged), height, width, depth, mode) + struct.pack(">I", len(palette)) + palette
            + struct.pack(">I", len(resources)) + resources + struct.pack(">I", len(section)) + section + struct.pack(">H", packing) + data)
