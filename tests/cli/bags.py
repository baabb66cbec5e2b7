"""Writes recordings of ROS 2, by the specifications alone: CDR, MCAP, LZ4, zstd, and the SQLite files of ros2 bag."""

import sqlite3
import struct
import zlib

JOINT_STATE = "sensor_msgs/msg/JointState"
MCAP_MAGIC = b"\x89MCAP0\r\n"
# Types of MCAP records.
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 1, 2, 3, 4, 5, 6, 15


class Cdr:
    """One message in plain CDR (DDS-XTYPES 7.4.3, version 1)."""

    def __init__(self, big=False):
        self.order, self.body = "><"[not big], b""

    def add(self, code, value):
        size = struct.calcsize(code)
        self.body += bytes(-len(self.body) % size) + struct.pack(self.order + code, value)
        return self

    def text(self, text):
        raw = text.encode() + b"\0"
        self.add("I", len(raw)).body += raw
        return self

    def doubles(self, values):
        self.add("I", len(values))
        for value in values:
            self.add("d", value)
        return self

    def header(self, stamp):
        return self.add("i", stamp // 10**9).add("I", stamp % 10**9).text("")

    def message(self):
        return bytes([0, self.order == "<", 0, 0]) + self.body


def joint_state(stamp, names, positions, efforts=(), big=False):
    """`stamp` in ns."""
    cdr = Cdr(big).header(stamp).add("I", len(names))
    for name in names:
        cdr.text(name)
    return cdr.doubles(positions).doubles([]).doubles(efforts).message()


def wrench(stamp, force_y):
    cdr = Cdr().header(stamp)
    for value in (0.0, force_y, 0.0, 0.0, 0.0, 0.0):
        cdr.add("d", value)
    return cdr.message()


def float64(value):
    return Cdr().add("d", value).message()


# ---- containers: messages are (topic, type, log time in ns, bytes) ---------------------------------------------------


def zstd(raw):
    """A frame of raw blocks (RFC 8878): magic number, descriptor (4-byte content size, one segment), size, blocks."""
    blocks = [raw[at : at + 65536] for at in range(0, len(raw), 65536)] or [b""]
    frame = b"\x28\xb5\x2f\xfd" + bytes([0xA0]) + struct.pack("<I", len(raw))
    for i, block in enumerate(blocks):
        frame += struct.pack("<I", len(block) << 3 | (i == len(blocks) - 1))[:3] + block
    return frame


def _record(opcode, body):
    return struct.pack("<BQ", opcode, len(body)) + body


def _string(text):
    return struct.pack("<I", len(text)) + text.encode()


def mcap(messages, chunk=None, pack=None, end=True, crc=True):
    """`chunk`: messages per chunk, or no chunks; `pack`: name and function of a compression; `end`: False for a recording
    that was cut off."""
    out = MCAP_MAGIC + _record(HEADER, _string("ros2") + _string("test"))
    topics, types, records = {}, {}, []  # numbers by name, and the records of the open chunk

    def close():
        raw = b"".join(records)
        name, packed = (pack[0], pack[1](raw)) if pack else ("", raw)
        return _record(CHUNK, struct.pack("<QQQI", 0, 0, len(raw), zlib.crc32(raw) if crc else 0) + _string(name) + struct.pack("<Q", len(packed)) + packed)

    for number, (topic, kind, time, data) in enumerate(messages):
        declarations = b""
        if kind not in types:
            types[kind] = len(types) + 1
            declarations += _record(SCHEMA, struct.pack("<H", types[kind]) + _string(kind) + _string("ros2msg") + _string(""))
        if topic not in topics:
            topics[topic] = len(topics)
            declarations += _record(CHANNEL, struct.pack("<HH", topics[topic], types[kind]) + _string(topic) + _string("cdr") + struct.pack("<I", 0))
        record = declarations + _record(MESSAGE, struct.pack("<HIQQ", topics[topic], number, time, time) + data)
        if not chunk:
            out += record
            continue
        records.append(record)
        if len(records) == chunk:
            out, records = out + close(), []
    out += close() if records else b""
    if not end:
        return out
    return out + _record(DATA_END, struct.pack("<I", 0)) + _record(FOOTER, struct.pack("<QQI", 0, 0, 0)) + MCAP_MAGIC


def db3(path, messages, pack=None, page=4096, wal=False):
    """Writes a database. With a write-ahead log (`wal`) its file stays empty until the connection, which is returned, is
    closed."""
    base = sqlite3.connect(path, isolation_level=None)
    base.execute(f"PRAGMA page_size={page}")
    if wal:
        base.execute("PRAGMA journal_mode=WAL")
        base.execute("PRAGMA wal_autocheckpoint=0")
    base.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    base.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
    base.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
    base.execute("BEGIN")
    topics = {}
    for topic, kind, time, data in messages:
        if topic not in topics:
            topics[topic] = len(topics) + 1
            base.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (topics[topic], topic, kind))
        base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", (topics[topic], time, pack(data) if pack else data))
    base.execute("COMMIT")
    if wal:
        return base
    base.close()
