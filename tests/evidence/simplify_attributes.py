"""Compares attributes of a simplified mesh with those of its original, by programs of its own:
python3 check.py ORIGINAL SIMPLIFIED. Reads .obj, .ply, .glb."""
import sys, json, struct, numpy as np
from scipy.spatial import cKDTree

def read_obj(path):
    v, vt, vn, vc, tris, mats = [], [], [], [], [], []
    mat = ''
    for line in open(path, errors='replace'):
        w = line.split()
        if not w: continue
        if w[0] == 'v':
            v.append([float(x) for x in w[1:4]])
            vc.append([float(x) for x in w[4:7]] if len(w) >= 7 else None)
        elif w[0] == 'vt': vt.append([float(w[1]), float(w[2]) if len(w) > 2 else 0.0])
        elif w[0] == 'vn': vn.append([float(x) for x in w[1:4]])
        elif w[0] == 'usemtl': mat = line.strip()[7:].strip()
        elif w[0] == 'f':
            cs = []
            for c in w[1:]:
                p = (c.split('/') + ['', ''])[:3]
                ix = lambda s, n: None if s == '' else (int(s) - 1 if int(s) > 0 else n + int(s))
                cs.append((ix(p[0], len(v)), ix(p[1], len(vt)), ix(p[2], len(vn))))
            for i in range(1, len(cs) - 1):
                tris.append((cs[0], cs[i], cs[i + 1])); mats.append(mat)
    n = len(tris)
    P = np.array([[v[c[0]] for c in t] for t in tris], float).reshape(n, 3, 3)
    nan2, nan3 = [np.nan] * 2, [np.nan] * 3
    UV = np.array([[vt[c[1]] if c[1] is not None else nan2 for c in t] for t in tris], float).reshape(n, 3, 2)
    N = np.array([[vn[c[2]] if c[2] is not None else nan3 for c in t] for t in tris], float).reshape(n, 3, 3)
    C = np.array([[vc[c[0]] or nan3 for c in t] for t in tris], float).reshape(n, 3, 3)
    return P, UV, N, C, mats

def read_glb(path):
    b = open(path, 'rb').read()
    jl = struct.unpack('<I', b[12:16])[0]
    j = json.loads(b[20:20 + jl]); o = 20 + jl
    binary = b[o + 8:o + 8 + struct.unpack('<I', b[o:o + 4])[0]] if o < len(b) else b''
    types = {5120: 'i1', 5121: 'u1', 5122: 'i2', 5123: 'u2', 5125: 'u4', 5126: 'f4'}
    parts = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}
    def acc(i):
        a = j['accessors'][i]; bv = j['bufferViews'][a['bufferView']]
        t = np.dtype('<' + types[a['componentType']]); k = parts[a['type']]
        start = bv.get('byteOffset', 0) + a.get('byteOffset', 0); stride = bv.get('byteStride', t.itemsize * k)
        rows = [np.frombuffer(binary, t, k, start + r * stride) for r in range(a['count'])]
        x = np.array(rows, float)
        if a.get('normalized'): x /= np.iinfo(t).max
        return x
    out = [[], [], [], [], []]
    def visit(n, M):
        node = j['nodes'][n]
        L = np.eye(4)
        if 'matrix' in node: L = np.array(node['matrix'], float).reshape(4, 4).T
        else:
            if 'scale' in node: L = np.diag(list(node['scale']) + [1.0]) @ L
            if 'rotation' in node:
                x, y, z, w = node['rotation']
                R = np.eye(4); R[:3, :3] = [[1-2*(y*y+z*z), 2*(x*y-z*w), 2*(x*z+y*w)], [2*(x*y+z*w), 1-2*(x*x+z*z), 2*(y*z-x*w)], [2*(x*z-y*w), 2*(y*z+x*w), 1-2*(x*x+y*y)]]
                L = R @ L
            if 'translation' in node:
                T = np.eye(4); T[:3, 3] = node['translation']; L = T @ L
        M = M @ L
        if 'mesh' in node:
            for p in j['meshes'][node['mesh']]['primitives']:
                if p.get('mode', 4) != 4: continue
                at = p['attributes']; P = acc(at['POSITION']) @ M[:3, :3].T + M[:3, 3]
                I = acc(p['indices']).astype(int).ravel() if 'indices' in p else np.arange(len(P))
                I = I.reshape(-1, 3)
                m = p.get('material')
                mat = j['materials'][m] if m is not None else {}
                set_ = mat.get('pbrMetallicRoughness', {}).get('baseColorTexture', {}).get('texCoord', 0)
                get = lambda name, k: (acc(at[name])[:, :k] if name in at else np.full((len(P), k), np.nan))
                uv = get(f'TEXCOORD_{set_}', 2).copy(); uv[:, 1] = 1 - uv[:, 1]
                nm = get('NORMAL', 3) @ np.linalg.inv(M[:3, :3])
                c = get('COLOR_0', 3); c = np.where(c <= 0.0031308, 12.92 * c, 1.055 * np.abs(c) ** (1 / 2.4) - 0.055)
                out[0].append(P[I]); out[1].append(uv[I]); out[2].append(nm[I]); out[3].append(c[I]); out[4] += [mat.get('name', f'material {m}' if m is not None else '')] * len(I)
        for c in node.get('children', []): visit(c, M)
    for n in j['scenes'][j.get('scene', 0)]['nodes']: visit(n, np.eye(4))
    return [np.concatenate(x) for x in out[:4]] + [out[4]]

def read_ply(path):
    b = open(path, 'rb').read(); e = b.index(b'end_header') ; e = b.index(b'\n', e) + 1
    head = b[:e].decode(errors='replace').split('\n'); els = []; ascii_ = 'format ascii' in b[:e].decode(errors='replace'); big = 'big_endian' in b[:e].decode(errors='replace')
    T = {'char':'i1','int8':'i1','uchar':'u1','uint8':'u1','short':'i2','int16':'i2','ushort':'u2','uint16':'u2','int':'i4','int32':'i4','uint':'u4','uint32':'u4','float':'f4','float32':'f4','double':'f8','float64':'f8'}
    for l in head:
        w = l.split()
        if w[:1] == ['element']: els.append((w[1], int(w[2]), []))
        elif w[:1] == ['property']: els[-1][2].append((w[-1], w[1:-1]))
    V = {}; F = []; FT = []
    words = iter(b[e:].split()) if ascii_ else None; at = e; o = '>' if big else '<'
    def num(t):
        nonlocal at
        if ascii_: return float(next(words))
        d = np.dtype(o + T[t]); x = np.frombuffer(b, d, 1, at)[0]; at += d.itemsize; return float(x)
    for name, n, props in els:
        for _ in range(n):
            row = {}
            for pn, pt in props:
                if pt[0] == 'list': row[pn] = [num(pt[2]) for _ in range(int(num(pt[1])))]
                else: row[pn] = num(pt[0]) / (255.0 if pn in ('red', 'green', 'blue') and pt[0] in ('uchar', 'uint8') else 1.0)
            if name == 'vertex':
                for k, x in row.items(): V.setdefault(k, []).append(x)
            elif name == 'face':
                f = [int(x) for x in row.get('vertex_indices', row.get('vertex_index'))]; tc = row.get('texcoord')
                for i in range(1, len(f) - 1):
                    F.append((f[0], f[i], f[i + 1])); FT.append([tc[2 * q:2 * q + 2] for q in (0, i, i + 1)] if tc else [[np.nan] * 2] * 3)
    F = np.array(F); st = lambda *ns: np.array([V[x] for x in ns]).T if all(x in V for x in ns) else None
    P = st('x', 'y', 'z')[F]; n = len(F)
    uv = next((s for s in (st('s', 't'), st('u', 'v'), st('texture_u', 'texture_v')) if s is not None), None)
    UV = uv[F] if uv is not None else np.array(FT, float)
    N = st('nx', 'ny', 'nz'); C = st('red', 'green', 'blue')
    return P, UV, N[F] if N is not None else np.full((n, 3, 3), np.nan), C[F] if C is not None else np.full((n, 3, 3), np.nan), [''] * n

def read(path):
    e = path.lower().rsplit('.', 1)[1]
    return {'obj': read_obj, 'glb': read_glb, 'ply': read_ply}[e](path)

def sample(P, n, rng):
    a = np.linalg.norm(np.cross(P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]), axis=1); t = rng.choice(len(P), n, p=a / a.sum())
    r = rng.random((n, 2)); s = np.sqrt(r[:, 0]); w = np.stack([1 - s, s * (1 - r[:, 1]), s * r[:, 1]], 1)
    return t, w, np.einsum('nk,nkd->nd', w, P[t])

def closest(p, T):  # weights of the nearest points of triangles T to points p, one each
    a, b, c = T[:, 0], T[:, 1], T[:, 2]; ab, ac, ap = b - a, c - a, p - a
    dot = lambda x, y: np.einsum('nd,nd->n', x, y)
    d1, d2 = dot(ab, ap), dot(ac, ap); bp = p - b; d3, d4 = dot(ab, bp), dot(ac, bp); cp = p - c; d5, d6 = dot(ab, cp), dot(ac, cp)
    vc, vb, va = d1 * d4 - d3 * d2, d5 * d2 - d1 * d6, d3 * d6 - d5 * d4
    s = va + vb + vc; s = np.where(s == 0, 1, s); v, w = vb / s, vc / s
    W = np.stack([1 - v - w, v, w], 1)
    def edge(mask, i, j, t):
        t = np.clip(np.nan_to_num(t), 0, 1); x = np.zeros_like(W); x[:, i] = 1 - t; x[:, j] = t; W[mask] = x[mask]
    with np.errstate(all='ignore'):
        edge((va <= 0) & (d4 - d3 >= 0) & (d5 - d6 >= 0), 1, 2, (d4 - d3) / ((d4 - d3) + (d5 - d6)))
        edge((vb <= 0) & (d2 >= 0) & (d6 <= 0), 0, 2, d2 / (d2 - d6))
        edge((vc <= 0) & (d1 >= 0) & (d3 <= 0), 0, 1, d1 / (d1 - d3))
    for m, k in (((d1 <= 0) & (d2 <= 0), 0), ((d3 >= 0) & (d4 <= d3), 1), ((d6 >= 0) & (d5 <= d6), 2)):
        W[m] = np.eye(3)[k]
    return W

def compare(A, B, n=4000, dense=400000):
    rng = np.random.default_rng(1)
    P, UV, N, C, M = A; p, uv, nn, cc, m = B
    ok = np.linalg.norm(np.cross(P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]), axis=1) > 0
    P, UV, N, C = P[ok], UV[ok], N[ok], C[ok]; M = [x for x, k in zip(M, ok) if k]
    dt, _, dp = sample(P, dense, rng); dp = np.concatenate([dp, P.reshape(-1, 3)]); dt = np.concatenate([dt, np.repeat(np.arange(len(P)), 3)])
    tree = cKDTree(dp); t, w, q = sample(p, n, rng); K = 48
    _, near = tree.query(q, K); cand = dt[near]
    diag = np.linalg.norm(P.reshape(-1, 3).max(0) - P.reshape(-1, 3).min(0))
    W = closest(np.repeat(q, K, 0), P[cand.ravel()]); at = np.einsum('nk,nkd->nd', W, P[cand.ravel()])
    D = np.linalg.norm(at - np.repeat(q, K, 0), axis=1).reshape(n, K); best = D.min(1, keepdims=True)
    # All points about as near as the nearest one may be meant: sides of a seam, sheets on each other.
    tie = D <= best + np.maximum(best, 1e-4 * diag)
    def off(X, x, unit=False):
        if np.isnan(X).all() or np.isnan(x).all(): return None
        want = np.einsum('nk,nkd->nd', W, X[cand.ravel()]).reshape(n, K, -1); got = np.einsum('nk,nkd->nd', w, x[t])[:, None]
        if unit:
            want = want / np.linalg.norm(want, axis=2, keepdims=True); got = got / np.linalg.norm(got, axis=2, keepdims=True)
            e = np.degrees(np.arccos(np.clip((want * got).sum(2), -1, 1)))
        else: e = np.linalg.norm(want - got, axis=2)
        e = np.where(tie, e, np.inf); e[np.isnan(e)] = np.inf; e = e.min(1); e = e[np.isfinite(e)]
        return [float(np.sqrt((e ** 2).mean())), float(np.percentile(e, 99)), float(e.max())]
    same = np.mean([m[t[i]] in {M[c] for c, k in zip(cand[i], tie[i]) if k} for i in range(n)])
    return dict(faces=len(P), left=len(p), distance_rms=float(np.sqrt((best ** 2).mean()) / diag), uv=off(UV, uv), normal_deg=off(N, nn, True), colour=off(C, cc), material=float(same) if any(m) else None)

if __name__ == '__main__':
    print(json.dumps(compare(read(sys.argv[1]), read(sys.argv[2]))))
