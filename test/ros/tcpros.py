# SPDX-License-Identifier: GPL-3.0-or-later
"""TCPROS and the slave API by hand: what a peer may do that roscpp and rospy would not."""
import os
import socket
import struct
import threading
import xmlrpc.client
import xmlrpc.server

NAME = "/stranger"


def master(uri=None):
    return xmlrpc.client.ServerProxy(uri or os.environ["ROS_MASTER_URI"])


def call(proxy, method, *arguments):
    """The value of a call by the master or slave API, whose code says that it succeeded."""
    code, said, value = getattr(proxy, method)(NAME, *arguments)
    if code != 1:
        raise RuntimeError("%s: %s" % (method, said))
    return value


def slave(node, uri=None):
    """The API of a node of this name, (host, port) of which are .address."""
    found = call(master(uri), "lookupNode", node)
    proxy = xmlrpc.client.ServerProxy(found)
    host, port = found.split("//")[1].rstrip("/").split(":")
    proxy.__dict__["address"] = (host, int(port))
    return proxy


def header(**fields):
    parts = [("%s=%s" % f).encode() for f in fields.items()]
    body = b"".join(struct.pack("<I", len(p)) + p for p in parts)
    return struct.pack("<I", len(body)) + body


def receive(connection, size):
    got = b""
    while len(got) < size:
        part = connection.recv(size - len(got))
        if not part:
            raise EOFError("closed after %d of %d bytes" % (len(got), size))
        got += part
    return got


def frame(connection):
    """The bytes of the next header or message."""
    return receive(connection, struct.unpack("<I", receive(connection, 4))[0])


def data_port(node, topic, uri=None):
    return tuple(call(slave(node, uri), "requestTopic", topic, [["TCPROS"]])[1:])


def listen(node, topic, kind, uri=None, buffer=None, callerid=NAME):
    """A connection as a subscriber of this topic of a node: after the header every frame() is a message."""
    connection = socket.socket()
    if buffer:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
    connection.settimeout(10.0)
    connection.connect(data_port(node, topic, uri))
    connection.sendall(header(callerid=callerid, topic=topic, type=kind._type, md5sum=kind._md5sum, tcp_nodelay="1"))
    frame(connection)
    return connection


class Speaker:
    """A publisher that sends any bytes, once somebody has subscribed.

    To the master it is `callerid`, to who subscribes `says`: the master ends an older node of the same name.
    """

    def __init__(self, topic, kind, callerid=NAME, says=None, uri=None, announced=True):
        self.topic, self.callerid, self.uri = topic, callerid, uri
        self.header = header(callerid=says or callerid, topic=topic, type=kind._type, md5sum=kind._md5sum, latching="0")
        self.door = socket.socket()
        self.door.bind(("localhost", 0))
        self.door.listen(5)
        self.door.settimeout(10.0)
        port = self.door.getsockname()[1]
        self.api = xmlrpc.server.SimpleXMLRPCServer(("localhost", 0), logRequests=False)
        self.api.register_function(lambda *_: (1, "", ["TCPROS", "localhost", port]), "requestTopic")
        threading.Thread(target=self.api.serve_forever, daemon=True).start()
        self.sending = threading.Lock()  # a message in two parts must not let another one in
        self.address = "http://localhost:%d/" % self.api.server_address[1]
        self.announced = announced
        if announced:
            master(uri).registerPublisher(callerid, topic, kind._type, self.address)
            self.accept()

    def accept(self):
        """The connection of who subscribes; one that is not announced to the master waits for none."""
        self.connection, _ = self.door.accept()
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        frame(self.connection)
        self.connection.sendall(self.header)

    def send(self, body):
        with self.sending:
            self.connection.sendall(struct.pack("<I", len(body)) + body)

    def close(self):
        if self.announced:
            master(self.uri).unregisterPublisher(self.callerid, self.topic, self.address)
        self.api.shutdown()
        self.api.server_close()
        self.connection.close()
        self.door.close()
