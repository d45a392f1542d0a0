#!/usr/bin/env python3
"""Whatever bytes come on the sockets of a node: it answers or drops them, and is as it was.

What it is fed with follows from the topics and services that the master knows of and their types: new
ones are tried, too.
"""
import contextlib
import itertools
import re
import socket
import struct
import sys
import threading
import time
import unittest
import xmlrpc.client
import xmlrpc.server

import genmsg.msgs
import rosgraph
import roslib.message
import rospy
import rostest
from cloth_tearing.msg import SimulationStatus
from cloth_tearing.srv import Step
from rosgraph_msgs.msg import Log

NODE = "/cloth"
ME = "/hostile"
HOST = "127.0.0.1"
PATIENCE = 20.0  # [s]; no wait takes longer, and a busy machine may need some of it
MOST_GROWTH = 16 * 1024  # of what the node ever had in memory [kB]
LIES = (0xffffffff, 0x7fffffff, 0x02000000)
MOST_DECLARED = 1000000000  # bytes; roscpp drops who declares more
UNKNOWN_MD5SUM = "0123456789abcdef0123456789abcdef"
# The lengths that these begin with are too large, not of what follows, or of nothing in a header.
GARBAGE = (b"\xff" * 64, struct.pack("<I", MOST_DECLARED + 1), struct.pack("<I", 8) + b"\xff" * 8,
           struct.pack("<II", 8, 0xfffffff0) + b"a=b!", struct.pack("<II", 8, 4) + b"none")
# roscpp waits for the rest of these, or for nothing at all.
HALVES = (b"GET / HTTP/1.1\r\nHost: cloth\r\n\r\n", struct.pack("<I", 200) + b"half a header",
          struct.pack("<II", 7, 3) + b"a=b", struct.pack("<I", 0), struct.pack("<I", MOST_DECLARED),
          b"\x01\x00", b"")
# What libraries listen to: texts are all that can have a wrong length there, and roscpp looks.
OF_LIBRARIES = re.compile(r".*/(pull|predict_pull|handles)/\w+")


class Example:
    """The bytes of a message whose arrays have two entries each, and where its counts are."""

    def __init__(self, message_class):
        self.bytes = b""
        self.counts = []  # (offset, least size of an element)
        self._write(message_class)

    def _write(self, message_class):
        for type_name in message_class._slot_types:
            base, is_array, length = genmsg.msgs.parse_type(type_name)
            if is_array and length is None:
                length = 2
                self._count(least_size(base), length)
            for _ in range(length or 1):
                self._write_one(base)

    def _write_one(self, base):
        if base == "string":
            self._count(1, 2)
            self.bytes += b"ab"
        elif base in genmsg.msgs.BUILTIN_TYPES:
            self.bytes += bytes(least_size(base))
        else:
            self._write(roslib.message.get_message_class(name_of(base)))

    def _count(self, least, count):
        self.counts.append((len(self.bytes), least))
        self.bytes += struct.pack("<I", count)

    def malformed(self):
        """All that is no message: each count lies in several ways, and the end comes too early."""
        for offset, least in self.counts:
            left = len(self.bytes) - offset - 4
            for lie in (*LIES, left // least + 1):
                yield self.bytes[:offset] + struct.pack("<I", lie) + self.bytes[offset + 4:]
        for length in range(len(self.bytes)):
            yield self.bytes[:length]


def name_of(base):
    return "std_msgs/Header" if base == "Header" else base


def least_size(base):
    """How many bytes a value of this type takes at least."""
    sizes = {"string": 4, "time": 8, "duration": 8, "bool": 1, "char": 1, "byte": 1}
    if base in sizes:
        return sizes[base]
    number = re.fullmatch(r"u?(?:int|float)(\d+)", base)
    if number:
        return int(number[1]) // 8
    total = 0
    for type_name in roslib.message.get_message_class(name_of(base))._slot_types:
        inner, is_array, length = genmsg.msgs.parse_type(type_name)
        total += 4 if is_array and length is None else least_size(inner) * (length or 1)
    return total


def header(**fields):
    """A TCPROS connection header."""
    encoded = b"".join(struct.pack("<I", len(field)) + field
                       for field in (f"{key}={value}".encode() for key, value in fields.items()))
    return struct.pack("<I", len(encoded)) + encoded


def read(connection, count):
    """So many bytes; fewer if the other side has dropped the connection before."""
    got = b""
    with contextlib.suppress(ConnectionError):
        while len(got) < count:
            more = connection.recv(count - len(got))
            if not more:
                break
            got += more
    return got


def read_block(connection):
    """A length and what follows, or None if the other side has dropped the connection."""
    length = read(connection, 4)
    return read(connection, struct.unpack("<I", length)[0]) if len(length) == 4 else None


def is_dropped(connection):
    """Whether the other side ends it in time, whatever it says before."""
    try:
        while read(connection, 4096):
            pass
        return True
    except socket.timeout:
        return False


def connect(address):
    return socket.create_connection(address, PATIENCE)


def send(connection, data):
    """Sends as much as the other side takes before it drops the connection."""
    with contextlib.suppress(ConnectionError):
        connection.sendall(data)


@contextlib.contextmanager
def trying(*what):
    """Says of a failure what it is about. (rostest hides the failures of subtests.)"""
    try:
        yield
    except (AssertionError, OSError) as error:
        raise AssertionError(f"{what}: {error}") from error


class Stopwatch:
    """The longest that anything took to be answered or dropped [s]."""

    longest = 0.0

    @classmethod
    @contextlib.contextmanager
    def lap(cls):
        start = time.monotonic()
        yield
        cls.longest = max(cls.longest, time.monotonic() - start)


class Node:
    """What can be known of the node from outside."""

    def __init__(self):
        self.master = rosgraph.Master(ME)
        self.changed = threading.Condition()
        self.status = None
        self.complaints = 0  # of roscpp, of bytes that it read itself
        self.listeners = [rospy.Subscriber(NODE + "/status", SimulationStatus, self._on_status),
                          rospy.Subscriber("/rosout", Log, self._on_log)]
        rospy.wait_for_service(NODE + "/step", PATIENCE)
        self.step = rospy.ServiceProxy(NODE + "/step", Step)
        with xmlrpc.client.ServerProxy(self.master.lookupNode(NODE)) as api:
            self.pid = api.getPid(ME)[2]
            self.port = api.requestTopic(ME, NODE + "/status", [["TCPROS"]])[2][2]
        self.wait_for(lambda: self.status is not None and self.listeners[1].get_num_connections())

    def _on_status(self, status):
        with self.changed:
            self.status = status
            self.changed.notify_all()

    def _on_log(self, log):
        with self.changed:
            self.complaints += log.name == NODE and "when deserializing" in log.msg
            self.changed.notify_all()

    def wait_for(self, condition):
        with self.changed:
            return self.changed.wait_for(condition, PATIENCE)

    def refused(self):
        return self.status.refusals + self.complaints

    def hash(self):
        return self.step(0).state_hash

    def highest_memory(self):
        with open(f"/proc/{self.pid}/status") as status:
            return int(re.search(r"VmHWM:\s*(\d+)", status.read())[1])  # [kB]

    def names(self, kind):
        """Of 0: topics it publishes; 1: topics it listens to; 2: services."""
        return sorted(name for name, nodes in self.master.getSystemState()[kind] if NODE in nodes)

    def address(self, service=None):
        """Where it takes connections: one port for all."""
        if service is None:
            return HOST, self.port
        return HOST, int(self.master.lookupService(service).rsplit(":", 1)[1])


class Publisher:
    """Tells the node that it publishes a topic, and says what nobody would."""

    def __init__(self, node, topic, type_name):
        self.node = node
        self.topic = topic
        self.type = type_name
        self.listener = socket.create_server((HOST, 0))
        self.listener.settimeout(PATIENCE)
        self.api = xmlrpc.server.SimpleXMLRPCServer((HOST, 0), logRequests=False)
        port = self.listener.getsockname()[1]
        self.api.register_function(lambda *_: [1, "", ["TCPROS", HOST, port]], "requestTopic")
        self.thread = threading.Thread(target=self.api.serve_forever, args=(0.01,))

    def __enter__(self):
        self.thread.start()
        self.uri = "http://{}:{}".format(*self.api.server_address)
        self.node.master.registerPublisher(self.topic, self.type, self.uri)
        self.connection, _ = self.listener.accept()
        self.connection.settimeout(PATIENCE)
        read_block(self.connection)  # what it asks for
        return self.connection

    def __exit__(self, *_):
        self.connection.close()
        self.node.master.unregisterPublisher(self.topic, self.uri)
        self.api.shutdown()
        self.thread.join()
        self.api.server_close()
        self.listener.close()


class HostileBytesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.node = Node()
        cls.hash = cls.node.hash()
        cls.memory = cls.node.highest_memory()

    @classmethod
    def tearDownClass(cls):
        print(f"answered or dropped within {1000.0 * Stopwatch.longest:.1f} ms, "
              f"memory grew by {cls.node.highest_memory() - cls.memory} kB")

    def tearDown(self):
        self.assertEqual(self.node.hash(), self.hash, "the cloth has changed")
        self.assertLess(self.node.highest_memory() - self.memory, MOST_GROWTH, "[kB]")

    def services(self):
        """Each with the header that it answers a probe with."""
        for name in self.node.names(2):
            with connect(self.node.address(name)) as probe:
                send(probe, header(callerid=ME, service=name, md5sum="*", probe=1))
                fields = (field.split("=", 1) for field in fields_of(read_block(probe)))
                yield name, dict(fields)

    def test_malformed_requests_are_answered_with_the_reason(self):
        tried = 0
        for name, about in self.services():
            example = Example(roslib.message.get_service_class(about["type"])._request_class)
            with trying(name), connect(self.node.address(name)) as connection:
                send(connection, header(callerid=ME, service=name, md5sum=about["md5sum"],
                                        persistent=1))
                self.assertIn(b"md5sum", read_block(connection))
                for body in example.malformed():
                    with Stopwatch.lap():
                        send(connection, struct.pack("<I", len(body)) + body)
                        self.assertEqual(read(connection, 1), b"\0", f"was done: {body}")
                        self.assertTrue(read_block(connection), "no reason")
                    tried += 1
        self.assertGreater(tried, 1000, "the node has lost its services")
        print(f"{tried} malformed requests to {len(self.node.names(2))} services")

    def test_malformed_messages_are_refused(self):
        types = dict(self.node.master.getTopicTypes())
        tried = 0
        for topic in self.node.names(1):
            example = Example(roslib.message.get_message_class(types[topic]))
            with trying(topic), Publisher(self.node, topic, types[topic]) as connection:
                send(connection, header(callerid=ME, type=types[topic], md5sum="*"))
                for body in example.malformed():
                    before = self.node.refused()
                    with Stopwatch.lap():
                        send(connection, struct.pack("<I", len(body)) + body)
                        self.assertTrue(self.node.wait_for(lambda: self.node.refused() > before),
                                        f"was not refused: {body}")
                    tried += 1
        self.assertGreater(tried, 1000, "the node has lost its topics")
        print(f"{tried} malformed messages on {len(self.node.names(1))} topics")

    def test_what_is_malformed_is_counted_and_told(self):
        with Publisher(self.node, NODE + "/spheres", "cloth_tearing/CollisionSpheres") as connection:
            send(connection, header(callerid=ME, type="cloth_tearing/CollisionSpheres", md5sum="*"))
            before = self.node.status.refusals
            send(connection, struct.pack("<IIIIII", 20, 0, 0, 0, 0, 0xffffffff))
            self.assertTrue(self.node.wait_for(lambda: self.node.status.refusals == before + 1))
        self.assertEqual(self.node.status.last_refusal,
                         "spheres: malformed: there have to be 4294967295 elements of at least 76 bytes, "
                         "but 0 bytes are left")

    def test_requests_of_too_many_bytes_are_dropped(self):
        for name, about in self.services():
            with trying(name), connect(self.node.address(name)) as connection:
                send(connection, header(callerid=ME, service=name, md5sum=about["md5sum"]))
                self.assertIn(b"md5sum", read_block(connection))
                with Stopwatch.lap():
                    send(connection, struct.pack("<I", 0xffffffff))
                    self.assertTrue(is_dropped(connection))

    def test_messages_of_too_many_bytes_are_dropped(self):
        types = dict(self.node.master.getTopicTypes())
        for topic in self.node.names(1):
            with trying(topic), Publisher(self.node, topic, types[topic]) as connection:
                send(connection, header(callerid=ME, type=types[topic], md5sum="*"))
                with Stopwatch.lap():
                    send(connection, struct.pack("<I", 0xffffffff))
                    self.assertTrue(is_dropped(connection))

    def test_those_who_mean_another_type_are_told_and_dropped(self):
        for name in self.node.names(2):
            self.expect_error(self.node.address(name), service=name, md5sum=UNKNOWN_MD5SUM)
        for topic in self.node.names(0):
            self.expect_error(self.node.address(), topic=topic, type="cloth_tearing/None",
                              md5sum=UNKNOWN_MD5SUM)

    def test_messages_of_another_type_are_refused(self):
        types = dict(self.node.master.getTopicTypes())
        for topic in self.node.names(1):
            if OF_LIBRARIES.fullmatch(topic):
                continue
            body = Example(roslib.message.get_message_class(types[topic])).bytes
            with trying(topic), Publisher(self.node, topic, types[topic]) as connection:
                send(connection, header(callerid=ME, type=types[topic], md5sum=UNKNOWN_MD5SUM))
                before = self.node.status.refusals
                with Stopwatch.lap():
                    send(connection, struct.pack("<I", len(body)) + body)
                    self.assertTrue(self.node.wait_for(lambda: self.node.status.refusals > before))
                self.assertIn(UNKNOWN_MD5SUM, self.node.status.last_refusal)

    def expect_error(self, address, **fields):
        with trying(fields), connect(address) as connection, Stopwatch.lap():
            send(connection, header(callerid=ME, **fields))
            self.assertIn(b"error=", read_block(connection))
            self.assertTrue(is_dropped(connection))

    def test_garbage_instead_of_a_header_is_dropped(self):
        for garbage in GARBAGE:
            with trying(garbage), connect(self.node.address()) as connection, Stopwatch.lap():
                send(connection, garbage)
                self.assertTrue(is_dropped(connection))
        types = dict(self.node.master.getTopicTypes())
        for topic, garbage in zip(self.node.names(1), itertools.cycle(GARBAGE)):
            with trying(topic, garbage), \
                    Publisher(self.node, topic, types[topic]) as connection, Stopwatch.lap():
                send(connection, garbage)
                self.assertTrue(is_dropped(connection))

    def test_those_who_stop_halfway_hold_up_nobody(self):
        types = dict(self.node.master.getTopicTypes())
        with contextlib.ExitStack() as open_ones:
            for half in HALVES:
                send(open_ones.enter_context(connect(self.node.address())), half)
            for topic, half in zip(self.node.names(1), itertools.cycle(HALVES)):
                send(open_ones.enter_context(Publisher(self.node, topic, types[topic])), half)
            for name, about in self.services():
                connection = open_ones.enter_context(connect(self.node.address(name)))
                send(connection, header(callerid=ME, service=name, md5sum=about["md5sum"]))
                self.assertIn(b"md5sum", read_block(connection))
                send(connection, struct.pack("<I", MOST_DECLARED) + b"half a request")
            self.assertEqual(self.node.hash(), self.hash)
            self.assertLess(self.node.highest_memory() - self.memory, MOST_GROWTH, "[kB]")


def fields_of(block):
    """The fields of a connection header."""
    at = 0
    while at < len(block):
        length, = struct.unpack_from("<I", block, at)
        yield block[at + 4:at + 4 + length].decode()
        at += 4 + length


if __name__ == "__main__":
    rospy.init_node("hostile_bytes_test")
    rostest.rosrun("cloth_tearing", "hostile_bytes", HostileBytesTest, sys.argv)
