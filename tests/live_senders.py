#!/usr/bin/env python3
"""live_senders.py OCTANT FOLDER [NAME...]: flies `octant listen` by models of senders over real sockets of 127.0.0.1.

Each sender flies 100 m/s (or as its row says) for half a minute; its truth is known here. What the recording's
frames.csv says was shown is judged against it, never by the program's own report: the speed of pictures over the
true one, pictures that move against the one before, packets called lost ("-": losses are unknown) and truly lost, and
the root mean square of the distance from the truth, after the mean delay is taken out. Prints a Markdown table.
"""
import csv, heapq, math, os, random, select, socket, struct, subprocess, sys, time

A, E2 = 6378137.0, 0.00669437999014
LAT0, LON0, ALT = math.radians(0.5), math.radians(10.0), 1500.0  # by the equator a map is nearly flat


class Flight:
    """East of the start; straight, or a level turn to the right."""

    def __init__(self, speed=100.0, turn_deg=0.0):
        self.v, self.w = speed, math.radians(turn_deg)

    def at(self, t):
        if self.w == 0.0:
            return self.v * t, 0.0
        return self.v / self.w * math.sin(self.w * t), self.v / self.w * (math.cos(self.w * t) - 1.0)

    def velocity(self, t):
        return self.v * math.cos(self.w * t), -self.v * math.sin(self.w * t)

    def geo(self, t, noise=0.0):
        x, y = self.at(t)
        x, y = x + random.gauss(0, noise), y + random.gauss(0, noise)
        s = math.sin(LAT0)
        m, n = A * (1 - E2) / (1 - E2 * s * s) ** 1.5, A / math.sqrt(1 - E2 * s * s)
        return LAT0 + y / m, LON0 + x / (n * math.cos(LAT0))

    def heading(self, t):
        vx, vy = self.velocity(t)
        return math.atan2(vx, vy) % (2 * math.pi)


def fdm(f, t, velocity=True, cur_time=0, quantum=False, rates=True):
    lat, lon = f.geo(t)
    if quantum:  # degrees in single precision, as X-Plane's DATA has them
        lat, lon = (math.radians(struct.unpack('f', struct.pack('f', math.degrees(a)))[0]) for a in (lat, lon))
    b = bytearray(408)
    struct.pack_into('>II3d', b, 0, 24, 0, lon, lat, ALT)
    struct.pack_into('>6f', b, 32, ALT, math.atan(f.v * f.w / 9.81), 0.02, f.heading(t), 0, 0)
    if velocity:
        vx, vy = f.velocity(t)
        struct.pack_into('>3f', b, 56, 0, 0, f.w if rates else 0.0)
        struct.pack_into('>3f', b, 76, vy / 0.3048, vx / 0.3048, 0)
    struct.pack_into('>I', b, 356, int(cur_time) & 0xffffffff)
    return bytes(b)


def crc(data, extra):
    c = 0xffff
    for b in data + bytes([extra]):
        b = (b ^ c) & 0xff
        b = (b ^ (b << 4)) & 0xff
        c = (c >> 8) ^ (b << 8) ^ (b << 3) ^ (b >> 4)
    return struct.pack('<H', c & 0xffff)


def mavlink(number, extra, payload, seq=[0]):
    seq[0] = (seq[0] + 1) & 0xff
    head = struct.pack('<BBBBBB', len(payload), 0, 0, seq[0], 1, 1) + struct.pack('<I', number)[:3]
    return b'\xfd' + head + payload + crc(head + payload, extra)


def attitude(f, t):
    h = (f.heading(t) + math.pi) % (2 * math.pi) - math.pi
    return mavlink(30, 39, struct.pack('<I6f', int(t * 1000) + 5000, 0.1, 0.02, h, 0, 0, f.w))


def position(f, t):
    (lat, lon), (vx, vy) = f.geo(t), f.velocity(t)
    return mavlink(33, 104, struct.pack(
        '<IiiiihhhH', int(t * 1000) + 5000, round(math.degrees(lat) * 1e7), round(math.degrees(lon) * 1e7), int(ALT * 1e3),
        int(ALT * 1e3), round(vy * 100), round(vx * 100), 0, round(math.degrees(f.heading(t)) * 100) % 36000))


def hil(f, t):
    (lat, lon), (vx, vy), h = f.geo(t), f.velocity(t), f.heading(t)
    return mavlink(115, 4, struct.pack('<Q4f3fiiihhhHHhhh', int(t * 1e6) + 10**9, math.cos(h / 2), 0, 0, math.sin(h / 2), 0, 0,
                                       f.w, round(math.degrees(lat) * 1e7), round(math.degrees(lon) * 1e7), int(ALT * 1e3),
                                       round(vy * 100), round(vx * 100), 0, 10000, 10000, 0, 0, 0))


def dis(f, t, pdu_time):
    lat, lon = f.geo(t)
    vx, vy = f.velocity(t)
    n = A / math.sqrt(1 - E2 * math.sin(lat) ** 2)
    ecef = ((n + ALT) * math.cos(lat) * math.cos(lon), (n + ALT) * math.cos(lat) * math.sin(lon),
            (n * (1 - E2) + ALT) * math.sin(lat))
    east = (-math.sin(lon), math.cos(lon), 0)
    north = (-math.sin(lat) * math.cos(lon), -math.sin(lat) * math.sin(lon), math.cos(lat))
    v = [vx * e + vy * k for e, k in zip(east, north)]
    b = bytearray(144)
    struct.pack_into('>BBBBIHH', b, 0, 6, 1, 1, 1, (int(pdu_time / 3600 * 2**31) << 1 | 1) & 0xffffffff, 144, 0)
    struct.pack_into('>HHHBB8B', b, 12, 1, 1, 7, 1, 0, 1, 2, 225, 1, 1, 0, 0, 0)
    struct.pack_into('>3f3d3f', b, 36, *v, *ecef, 0, 0, 0)
    b[88] = 2  # DRM_FPW
    return bytes(b)


def cigi(f, t, frame, timestamp, rate):
    lat, lon = f.geo(t)
    vx, vy = f.velocity(t)
    m = struct.pack('>BBBbBBHIIII', 1, 24, 3, 0, 1 | (4 if timestamp else 0) | 0x30, 0, 0x8000, frame, int(t * 1e5), 0, 0)
    m += struct.pack('>BBHBBBBHH3f3d', 2, 48, 0, 1, 0, 255, 0, 1, 0, 0, 0, math.degrees(f.heading(t)), math.degrees(lat),
                     math.degrees(lon), ALT)
    if rate:
        m += struct.pack('>BBHBBH6f', 8, 32, 0, 0, 0, 0, vy, vx, 0, 0, 0, math.degrees(f.w))
    return m


def line(f, t, form, noise=0.0):
    lat, lon = f.geo(t, noise)
    return (form(t) + f'{math.degrees(lat):.9f},{math.degrees(lon):.9f},{ALT},{math.degrees(f.heading(t)):.3f}\n').encode()


def xplane_values(f, t):
    """What X-Plane says of the flight, by the names of its data references; all in single precision on the wire."""
    (lat, lon), (x, y), (vx, vy) = f.geo(t), f.at(t), f.velocity(t)
    position = 'sim/flightmodel/position/'
    values = dict(latitude=math.degrees(lat), longitude=math.degrees(lon), elevation=ALT, y_agl=ALT, true_theta=1.0, true_phi=5.0,
                  true_psi=math.degrees(f.heading(t)), local_x=x - 20000, local_y=ALT, local_z=-y + 5000, local_vx=vx, local_vy=0.0,
                  local_vz=-vy, P=0.0, Q=0.0, R=math.degrees(f.w))
    return {position + name: value for name, value in values.items()}


def xplane_data(f, t, groups=(3, 17, 18, 20, 21), running=None):
    v = {name.rsplit('/', 1)[1]: value for name, value in xplane_values(f, t).items()}
    kt, none = f.v / 0.514444, -999.0
    rows = {1: (t, t, (running or 0) + t, t), 3: (kt, kt, kt, kt), 17: (1.0, 5.0, v['true_psi'], v['true_psi']),
            18: (1.0, 0.0, v['true_psi'], 0.0), 20: (v['latitude'], v['longitude'], ALT / 0.3048, ALT / 0.3048, 0, ALT / 0.3048),
            21: (v['local_x'], v['local_y'], v['local_z'], v['local_vx'], v['local_vy'], v['local_vz'])}
    b = b'DATA*'
    for g in groups:
        b += struct.pack('<i8f', g, *(rows[g] + (none,) * 8)[:8])
    return b


class XPlane:
    """Answers the RREF requests that come to a port, in one packet or in pieces, at its own times."""

    def __init__(self):
        self.asked, self.to = {}, None
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(('127.0.0.1', 0))
        self.socket.setblocking(False)
        self.port = self.socket.getsockname()[1]

    def listen(self):
        try:
            while True:
                request, self.to = self.socket.recvfrom(2000)
                rate, number = struct.unpack_from('<ii', request, 5)
                self.asked[number] = request[13:].split(b'\0')[0].decode()
                if rate == 0:
                    del self.asked[number]
        except BlockingIOError:
            pass

    def answer(self, f, t, running):
        values = xplane_values(f, t)
        values['sim/time/total_running_time_sec'] = running + t
        return b'RREF,' + b''.join(struct.pack('<if', n, values[name]) for n, name in self.asked.items())

    def send(self, packet):
        self.listen()
        if self.to and len(packet) > 5:
            self.socket.sendto(packet, self.to)


def every(rate, var=0.0, sleep_jitter=0.0):
    """Times between packets: even, or spread as waiting times are, or as a script that sleeps has them."""
    def next_(t, n):
        spread = random.expovariate(1 / var) + 1 - var if var else 1.0
        return spread / rate + abs(random.gauss(0, sleep_jitter))
    return next_


class Dead:
    """A DIS sender: a heartbeat of 5 s, or as soon as dead reckoning is a metre off."""

    def __call__(self, t, n, f=None):
        k = 0.05
        while k < 5.0:
            (x, y), (vx, vy), (tx, ty) = self.f.at(t), self.f.velocity(t), self.f.at(t + k)
            if math.hypot(x + vx * k - tx, y + vy * k - ty) > 1.0:
                break
            k += 0.05
        return k


def dead(f):
    d = Dead()
    d.f = f
    return d


def jsbsim(name):
    data, at, packets = open(name, 'rb').read(), 0, []
    while at < len(data):
        n = struct.unpack_from('>H', data, at)[0]
        packets.append(data[at + 2:at + 2 + n])
        at += 2 + n
    return packets


class Replay:
    """A capture of JSBSim: its truth are its own packets, 66.7 or 60 a second."""

    def __init__(self, packets, rate):
        self.packets, self.rate = packets, rate
        lon, lat, _ = struct.unpack_from('>3d', packets[0], 8)
        self.lon0, self.lat0 = lon, lat

    def place(self, i):
        lon, lat, _ = struct.unpack_from('>3d', self.packets[min(i, len(self.packets) - 1)], 8)
        s = math.sin(self.lat0)
        m, n = A * (1 - E2) / (1 - E2 * s * s) ** 1.5, A / math.sqrt(1 - E2 * s * s)
        return (lon - self.lon0) * n * math.cos(self.lat0), (lat - self.lat0) * m

    def at(self, t):
        k = max(t * self.rate, 0.0)
        i = int(k)
        a, b = self.place(i), self.place(i + 1)
        return tuple(p + (k - i) * (q - p) for p, q in zip(a, b))

    def velocity(self, t):
        a, b = self.at(t - 0.1), self.at(t + 0.1)
        return tuple((q - p) / 0.2 for p, q in zip(a, b))


def senders(data):
    s, turn = Flight(), Flight(turn_deg=6)
    rows = []

    def add(name, kind, f, packet, times, **more):
        rows.append(dict(name=name, kind=kind, f=f, packet=packet, times=times, **more))
    if data:
        for name, rate in (('c172', 60.0), ('ah1s', 1 / 0.015)):
            r = Replay(jsbsim(f'{data}/jsb_{name}.bin'), rate)
            add(f'JSBSim capture {name}, bursts to 88 ms', 'fdm', r,
                lambda t, n, r=r: r.packets[min(n, len(r.packets) - 1)], every(rate), burst=0.044,
                seconds=len(r.packets) / rate - 0.2)
    add('JSBSim 66.6/s, cur_time 1e-6, bursts', 'fdm', turn, lambda t, n: fdm(turn, t, cur_time=t * 1e6 + 4290e6), every(66.6),
        burst=0.088)
    add('ArduPilot: ATTITUDE 50/s, GLOBAL_POSITION_INT 10/s', 'mavlink', turn,
        lambda t, n: attitude(turn, t) if n % 6 else position(turn, t), every(60, sleep_jitter=0.002))
    add('PX4 bridge: HIL_STATE_QUATERNION 100/s, 1 % lost', 'mavlink', turn, lambda t, n: hil(turn, t), every(100), loss=0.01)
    add('Paparazzi: FDM 25/s, no velocities, cur_time in seconds', 'fdm', turn,
        lambda t, n: fdm(turn, t, False, 1700000000 + t), every(25, sleep_jitter=0.004))
    add('MATLAB block: 100/s, no velocities, no clock', 'fdm', turn, lambda t, n: fdm(turn, t, False), every(100, sleep_jitter=0.002),
        jitter=0.008)
    add('X-Plane: 20/s, places in single precision', 'fdm', turn, lambda t, n: fdm(turn, t, quantum=True, rates=False),
        every(20, sleep_jitter=0.003))
    add('CIGI host 60/s, timestamps and rates', 'cigi', turn, lambda t, n: cigi(turn, t, n, True, True), every(60), jitter=0.005)
    add('CIGI host 30/s, neither', 'cigi', turn, lambda t, n: cigi(turn, t, n, False, False), every(30), jitter=0.005, loss=0.01)
    slow = Flight(150.0, 2.0)
    add('DIS, heartbeats of 5 s and 1 m, turning', 'dis', slow, lambda t, n: dis(slow, t, t), dead(slow))
    add('DIS, heartbeats of 5 s, straight', 'dis', s, lambda t, n: dis(s, t, t), every(0.2), seconds=40)
    add('lines on standard input, 20/s by sleep, no times', 'stdin', turn, lambda t, n: line(turn, t, lambda t: ''),
        every(20, sleep_jitter=0.005), names='')
    add('lines by TCP, t_s in milliseconds by mistake', 'tcp', s, lambda t, n: line(s, t, lambda t: f'{t * 1e3:.0f},'), every(20),
        names='t_s,')
    gps = Flight(50.0, 3.0)
    add('GPS 5/s by TCP, 0.5 m noise, no times', 'tcp', gps, lambda t, n: line(gps, t, lambda t: '', 0.5),
        every(5, sleep_jitter=0.01), names='')
    for rate in (5, 10, 20, 30, 60):
        add(f'FDM {rate}/s, 60 % uneven, no velocities', 'fdm', turn, lambda t, n: fdm(turn, t, False), every(rate, 0.6))
    for rate in (5, 10, 20, 30, 60):
        add(f'X-Plane DATA {rate}/s, 60 % uneven, 3 % lost', 'xplane', turn, lambda t, n: xplane_data(turn, t), every(rate, 0.6),
            loss=0.03)
    add('X-Plane DATA 20/s, groups 17 and 20 alone, 3 % lost', 'xplane', turn, lambda t, n: xplane_data(turn, t, (17, 20)),
        every(20, sleep_jitter=0.003), loss=0.03)
    add('X-Plane DATA 20/s with group 1, 3 % lost', 'xplane', turn, lambda t, n: xplane_data(turn, t, (1, 3, 17, 18, 20, 21), 9000),
        every(20, 0.6), loss=0.03)
    for rate in (5, 10, 20, 30, 60):
        add(f'X-Plane RREF {rate}/s, 60 % uneven, 3 % lost', 'rref', turn, lambda t, n, x: x.answer(turn, t, 100), every(rate, 0.6),
            loss=0.03)
    add('X-Plane RREF 60/s, 3 % lost, running for 6 hours', 'rref', turn, lambda t, n, x: x.answer(turn, t, 21600),
        every(60, sleep_jitter=0.002), loss=0.03)
    add('X-Plane RREF 60/s, 3 % lost, running for 48 hours', 'rref', turn, lambda t, n, x: x.answer(turn, t, 172800),
        every(60, sleep_jitter=0.002), loss=0.03)
    add('FDM 30/s, jitter 40 ms, 5 % lost, stall of 0.8 s', 'fdm', turn, lambda t, n: fdm(turn, t), every(30), jitter=0.04,
        loss=0.05, stall=12.0)
    add('FDM 30/s, the same without velocities', 'fdm', turn, lambda t, n: fdm(turn, t, False), every(30), jitter=0.04,
        loss=0.05, stall=12.0)
    return rows


def free_port(kind):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM if kind else socket.SOCK_STREAM) as s:
        s.bind(('127.0.0.1', 0))
        return s.getsockname()[1]


def fly(octant, folder, row):
    kind, f = row['kind'], row['f']
    port = free_port(kind not in ('stdin', 'tcp'))
    ports = {k: '-1' for k in ('fdm', 'mavlink', 'dis', 'cigi', 'xplane')}
    asked = XPlane() if kind == 'rref' else None
    ports['xplane' if asked else kind] = str(port)
    words = [octant, 'listen', '--headless', '--terrain', 'none', '--size', '64x36', '--samples', '1', '--pictures', '0', '--record',
             folder, '--seconds', str(row.get('seconds', 30) + 4), '--quiet']
    words += ['--xplane', f'127.0.0.1:{asked.port}'] if asked else []
    for k, p in ports.items():
        if k in ('stdin', 'tcp'):
            continue
        words += [f'--{k}-port', p]
    words += ['--from', '-'] if kind == 'stdin' else ['--lines-port', str(port)] if kind == 'tcp' else []
    run = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    time.sleep(3.0)
    if kind == 'tcp':
        s = socket.create_connection(('127.0.0.1', port))
        send = s.sendall
    elif asked:
        asked.listen()
        send = asked.send
    elif kind == 'stdin':
        send = lambda b: (run.stdin.write(b), run.stdin.flush())
    else:
        s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        send = lambda b: s.sendto(b, ('127.0.0.1', port))
    if kind in ('tcp', 'stdin'):
        send((row['names'] + 'lat_deg,lon_deg,alt_m,yaw_deg\n').encode())
    t0, next_, n, lost, queue, stall, began = time.monotonic(), 0.0, 0, 0, [], row.get('stall'), None
    try:
        while True:
            t = time.monotonic() - t0
            if t > row.get('seconds', 30):
                break
            if stall and t > stall:
                time.sleep(0.8)
                stall, next_ = None, time.monotonic() - t0
                continue
            if t >= next_:
                packet = row['packet'](t if not isinstance(f, Replay) else next_, n, *([asked] if asked else []))
                if random.random() < row.get('loss', 0.0):
                    lost += 1
                else:
                    due = t + random.random() * row.get('jitter', 0.0)
                    due = math.ceil(due / row['burst']) * row['burst'] if 'burst' in row else due
                    heapq.heappush(queue, (due, n, packet))
                n += 1
                next_ += row['times'](t, n)
            while queue and queue[0][0] <= time.monotonic() - t0:
                send(heapq.heappop(queue)[2])
            due = min([next_] + [q[0] for q in queue[:1]])
            time.sleep(max(0.0, min(due - (time.monotonic() - t0), 0.05)))
    except BrokenPipeError:
        pass
    if kind == 'stdin':
        run.stdin.close()
        run.stdin = None
    run.communicate()
    return n, lost


def percentile(values, share):
    values = sorted(values)
    return values[int(share * (len(values) - 1))]


def judge(folder, f, seconds):
    rows = list(csv.DictReader(open(folder + '/frames.csv')))
    known = [int(r['packets_lost']) for r in rows if r['packets_lost']]
    lost = sum(known) if known else '-'
    t = [float(r['sim_time_s']) for r in rows]
    p = [(float(r['aircraft_x_m']), float(r['aircraft_y_m'])) for r in rows]
    first = next(i for i in range(len(rows)) if sum(int(r['packets']) for r in rows[:i + 1]) > 0)
    x0, y0 = p[first]
    k0, k1 = t[first] + 4.0, t[first] + seconds - 1.0
    inside = [i for i in range(1, len(t)) if k0 < t[i] < k1 and t[i] > t[i - 1]]
    # Where the sender's time zero lies on the recording's clock: the mean along the flight, by a search.
    fx, fy = f.at(0.0)

    def errors(zero):
        found = []
        for i in inside[::3]:
            x, y = f.at(t[i] - zero)
            found.append((p[i][0] - x0 - x + fx, p[i][1] - y0 - y + fy))
        return found

    def cost(zero):
        return sum(x * x + y * y for x, y in errors(zero))
    zero = min((t[first] + 0.02 * k for k in range(-40, 41)), key=cost)
    for step in (0.004, 0.001, 0.0002):
        zero = min((zero + step * k for k in range(-6, 7)), key=cost)
    rms = math.sqrt(cost(zero) / len(errors(zero)))
    steps, speeds = [], []
    for i in inside:
        d = tuple(b - a for a, b in zip(p[i - 1], p[i]))
        v = math.hypot(*f.velocity(t[i] - zero))
        if v > 1.0:
            speeds.append(math.hypot(*d) / (t[i] - t[i - 1]) / v)
        steps.append(d)
    back = sum(a[0] * b[0] + a[1] * b[1] < 0 for a, b in zip(steps, steps[1:]))
    return speeds, back, lost, rms, len(inside)


def main():
    octant, folder, names = sys.argv[1], sys.argv[2], sys.argv[3:]
    data = os.environ.get('OCTANT_LINKS')
    print('| sender | speed over the true one: median, 1 % to 99 % | pictures, backwards | called lost, truly lost | rms m |')
    print('|---|---|---|---|---|')
    for number, row in enumerate(senders(data)):
        if names and not any(n in row['name'] for n in names):
            continue
        random.seed(number + 1)
        record = f'{folder}/{number}'
        _, lost = fly(octant, record, row)
        speeds, back, called, rms, pictures = judge(record, row['f'], row.get('seconds', 30))
        speed = f'{percentile(speeds, .5):.3f}, {percentile(speeds, .01):.2f} to {percentile(speeds, .99):.2f}' if speeds else 'stands'
        print(f"| {row['name']} | {speed} | "
              f"{pictures}, {back} | {called}, {lost} | {rms:.2f} |", flush=True)


main()
