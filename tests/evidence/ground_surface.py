#!/usr/bin/python3
"""Measures the surface of the ground in pictures of 1280 x 720 pixels: crawling, contrast, error and cost.

Usage: PYTHONPATH=build/release/python tests/evidence/ground_surface.py [--maps DIR] [--set KEY=VALUE] [--pictures DIR]
Without --maps the places lie on made ground. One line a place:

crawl      pixels that change by more than 16 levels in any channel when the camera turns by half a pixel
contrast   root mean square of the luminance after averaging 4 x 4 pixels, less its mean over 32 x 32 pixels, of ground
psnr       dB against the mean of 64 pictures whose lens is shifted by eighths of a pixel: 64 samples a pixel
larger     dB against the picture of 2560 x 1440 pixels, reduced to half: 64 samples a pixel of the finer surface
cpu        CPU milliseconds a picture, median of 15

With --order instead, six headings a place: pixels painted in order that differ by more than 16 levels from each of the
3 x 3 pixels around them in the picture painted by depth, and the pictures' hashes, to compare runs with other numbers
of threads and other instruction sets.
"""
import argparse
import hashlib
import os
import sys
import time

import numpy as np

import octant

WIDTH, HEIGHT = 1280, 720
FOCAL_PX = 0.5 * HEIGHT / np.tan(np.radians(22.5))

# Map, made ground in its place, share of its half width east and north, metres above ground, heading, pitch, sun's
# azimuth and elevation, degrees.
PLACES = [
    ("vancouver_2049.tif", "hills", 0.35, 0.40, 300, 320, -12, 135, 40),
    ("vancouver_2049.tif", "hills", -0.10, 0.55, 1500, 60, -25, 220, 25),
    ("vancouver_2049.tif", "hills", 0.20, -0.30, 60, 200, -8, 180, 50),
    ("pugetsound_1025.tif", "hills", 0.50, -0.40, 2500, 110, -20, 160, 35),
    ("pugetsound_1025.tif", "hills", -0.45, 0.10, 400, 270, -10, 250, 15),
    ("gcanyon_1025_smooth.tif", "canyon", 0.10, 0.05, 500, 30, -15, 120, 35),
    ("gcanyon_1025_smooth.tif", "canyon", -0.50, -0.30, 120, 150, -10, 230, 45),
    ("N51E000.hgt", "background60", 0.10, 0.20, 200, 90, -12, 170, 40),
    ("srtm3_N49W123.tif", "canyon", 0.30, 0.50, 800, 180, -30, 140, 45),
    ("srtm3_N49W123.tif", "hills", -0.40, 0.60, 250, 350, -9, 200, 30),
    # Ten more for the error alone.
    ("vancouver_2049.tif", "hills", -0.60, -0.20, 800, 90, -45, 135, 40),
    ("vancouver_2049.tif", "canyon", 0.55, 0.65, 100, 10, -30, 100, 60),
    ("pugetsound_1025.tif", "hills", 0.05, 0.45, 1200, 200, -35, 180, 55),
    ("pugetsound_1025.tif", "hills", 0.60, -0.55, 200, 300, -15, 135, 10),
    ("gcanyon_1025_smooth.tif", "canyon", 0.40, 0.50, 2000, 225, -30, 90, 30),
    ("gcanyon_1025_smooth.tif", "canyon", -0.15, 0.35, 50, 60, -20, 180, 60),
    ("N51E000.hgt", "background60", -0.50, -0.55, 1000, 20, -20, 200, 25),
    ("N51E000.hgt", "hills", 0.40, -0.10, 30, 140, -15, 150, 45),
    ("srtm3_N49W123.tif", "hills", 0.55, -0.20, 3000, 270, -40, 180, 40),
    ("srtm3_N49W123.tif", "background60", 0.10, 0.75, 150, 120, -20, 120, 35),
]


def camera_at(shift_px=(0.0, 0.0), larger=1, samples=16):
    """A lens whose picture is moved by so much, or so many times larger."""
    focal = FOCAL_PX * larger
    wide, high = WIDTH * larger, HEIGHT * larger
    lens = [[focal, 0, 0.5 * wide + shift_px[0]], [0, focal, 0.5 * high + shift_px[1]], [0, 0, 1]]
    return octant.Camera(wide, high, K=lens, samples=samples)


class Place:
    def __init__(self, row, maps, settings):
        name, made, east, north, above_m, self.heading, self.pitch, azimuth, elevation = row
        terrain = os.path.join(maps, name) if maps else made
        self.name = name if maps else made
        self.settings = dict(terrain=terrain, sun_azimuth=azimuth, sun_elevation=elevation, **settings)
        self.world = octant.World(**self.settings)
        half = self.world.ground.half_extent_m
        at = np.array([east * half[0], north * half[1]])
        ground_m = float(self.world.ground.height_m(at[0], at[1]))
        self.eye = np.array([at[0], at[1], ground_m + above_m])

    def picture(self, turn_px=0.0, camera=None, outputs=("rgb",)):
        look = octant.attitudes(heading_deg=self.heading + np.degrees(np.arctan(turn_px / FOCAL_PX)),
                                pitch_deg=self.pitch)
        frames = self.world.render(camera or camera_at(), self.eye, look, outputs=outputs)
        return frames.rgb[0] if len(outputs) == 1 else frames

    def crawl(self, samples=16):
        before, after = (self.picture(turn, camera_at(samples=samples)).astype(np.int16) for turn in (0.0, 0.5))
        return int((np.abs(after - before).max(axis=2) > 16).sum())

    def contrast(self):
        frames = self.picture(outputs=("rgb", "class_id"))
        ground = frames.class_id[0] == octant.classes.index("terrain")
        light = frames.rgb[0] @ np.array([0.2126, 0.7152, 0.0722])
        small = light.reshape(HEIGHT // 4, 4, WIDTH // 4, 4).mean(axis=(1, 3))
        all_ground = ground.reshape(HEIGHT // 4, 4, WIDTH // 4, 4).all(axis=(1, 3))
        rows = HEIGHT // 32 * 8
        blocks = small[:rows].reshape(rows // 8, 8, WIDTH // 32, 8)
        kept = all_ground[:rows].reshape(rows // 8, 8, WIDTH // 32, 8).all(axis=(1, 3))
        rest = blocks - blocks.mean(axis=(1, 3), keepdims=True)
        return float(np.sqrt((rest ** 2).mean(axis=(1, 3))[kept].mean()))

    def psnr(self, samples=16):
        steps = (np.arange(8) + 0.5) / 8 - 0.5
        total = np.zeros((HEIGHT, WIDTH, 3))
        for y in steps:
            for x in steps:
                total += self.picture(camera=camera_at((x, y), samples=samples))
        return error_db(total / 64, self.picture(camera=camera_at(samples=samples)))

    def psnr_of_larger(self):
        """Against the same picture twice as large, whose 16 samples are those 64: finer pixels see finer ground."""
        large = self.picture(camera=camera_at(larger=2)).astype(float)
        return error_db(large.reshape(HEIGHT, 2, WIDTH, 2, 3).mean(axis=(1, 3)), self.picture())

    def order(self):
        """Pixels that are wrong beyond the rounding of edges in six headings, and a hash of all pictures."""
        hashed = hashlib.sha256()
        wrong = []
        with octant.World(**self.settings, hidden_surface="depth-buffer") as by_depth:
            for turn in range(0, 360, 60):
                look = octant.attitudes(heading_deg=self.heading + turn, pitch_deg=self.pitch)
                ordered, deep = (world.render(camera_at(), self.eye, look, outputs=("rgb",)).rgb[0]
                                 for world in (self.world, by_depth))
                hashed.update(ordered.tobytes())
                around = np.pad(deep.astype(np.int16), ((1, 1), (1, 1), (0, 0)), mode="edge")
                least = np.full((HEIGHT, WIDTH), 255)
                for y in range(3):
                    for x in range(3):
                        off = np.abs(around[y:y + HEIGHT, x:x + WIDTH] - ordered).max(axis=2)
                        least = np.minimum(least, off)
                wrong.append(int((least > 16).sum()))
        return wrong, hashed.hexdigest()[:16]

    def cpu_ms(self):
        times = []
        for _ in range(15):
            start = time.process_time()
            self.picture()
            times.append(1e3 * (time.process_time() - start))
        return float(np.median(times))


def error_db(wanted, got):
    return float(10 * np.log10(255.0 ** 2 / np.mean((wanted - got) ** 2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--maps", help="folder of the maps that PLACES names")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a setting of octant.World")
    parser.add_argument("--pictures", help="folder for a PNG file a place")
    parser.add_argument("--samples", type=int, default=16, help="a pixel, of crawl and psnr")
    parser.add_argument("--order", action="store_true", help="painting order against depth, and hashes")
    parser.add_argument("--quick", action="store_true", help="crawl and contrast of the first ten places alone")
    arguments = parser.parse_args()
    settings = dict(each.split("=", 1) for each in arguments.set)
    settings = {key: {"True": True, "False": False}.get(value, value) for key, value in settings.items()}
    if arguments.order:
        print("place map                       wrong                    pictures")
    else:
        print("place map                        crawl  contrast    psnr  larger     cpu")
    for number, row in enumerate(PLACES[:10] if arguments.quick else PLACES):
        place = Place(row, arguments.maps, settings)
        if arguments.order:
            wrong, pictures = place.order()
            print(f"{number:5d} {place.name:25s} {' '.join(map(str, wrong)):24s} {pictures}", flush=True)
            place.world.close()
            continue
        line = f"{number:5d} {place.name:25s} {place.crawl(arguments.samples):8d} {place.contrast():9.2f}"
        if not arguments.quick:
            line += f" {place.psnr(arguments.samples):7.2f} {place.psnr_of_larger():7.2f} {place.cpu_ms():7.1f}"
        print(line, flush=True)
        if arguments.pictures:
            os.makedirs(arguments.pictures, exist_ok=True)
            octant.Picture(place.picture()).save(os.path.join(arguments.pictures, f"{number:02d}.png"))
        place.world.close()


if __name__ == "__main__":
    sys.exit(main())
