#!/usr/bin/env python3
"""Measures the constants of independent_renderer_test.cpp with Mitsuba 3 (`pip install mitsuba==3.9.1 numpy`).

Prints one line per ray: the scene, the point that the ray from the scene's eye goes through, the mean radiance of red,
green and blue, and the largest standard error of the three. Spaces are Macula's: metres, +Y up. Takes some
ten minutes of one core; the build and the tests do not run it.
"""

import argparse

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
T = mi.ScalarTransform4f

# Samples of one run. From the spread of the runs' means comes the standard error; a run is short because Mitsuba adds
# up its samples in single precision: one of 65,536 was wrong by 1.6e-4.
RUN = 1024


def gray(value):
    return {"type": "rgb", "value": [value] * 3}


def rgb(*value):
    return {"type": "rgb", "value": list(value)}


def matte(value):
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": gray(value)}}


def rectangle(to_world, **more):
    """Mitsuba's rectangle: -1..1 in x and y, its front towards +z."""
    return {"type": "rectangle", "to_world": to_world, **more}


FLOOR = T().rotate([1, 0, 0], -90) @ T().scale(10)
DOWN = T().rotate([1, 0, 0], 90)


def lamp(position, tilt_deg, half):
    """A square of radiance 10 that shines down, tilted about +z."""
    place = T().translate(position) @ T().rotate([0, 0, 1], tilt_deg) @ DOWN @ T().scale(half)
    return rectangle(place, bsdf=matte(0.0), emitter={"type": "area", "radiance": gray(10.0)})


DIRECT = {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}


def lit_floor(lamp_, **more):
    return {"type": "scene", "integrator": DIRECT, "floor": rectangle(FLOOR, bsdf=matte(0.5)), "lamp": lamp_, **more}


def metal_floor(roughness, light, color):
    metal = {"type": "principled", "metallic": 1.0, "roughness": roughness, "base_color": rgb(*color)}
    point = {"type": "point", "position": light, "intensity": gray(10.0)}
    return {"type": "scene", "integrator": DIRECT, "floor": rectangle(FLOOR, bsdf=metal), "lamp": point}


def glass_ball(ior):
    """A ball before a chart whose red grows with x and whose green grows with y, in uniform surroundings.

    It is large and lies at the origin because Mitsuba's rays start 9e-5 (1 + largest coordinate) off a surface: of a
    ball of 1 m at z = -4 that is enough to change what passes near its edge by .0015.
    """
    red_green = np.array([[[0, 0, 1], [1, 0, 1]], [[0, 1, 1], [1, 1, 1]]], dtype=np.float32)
    chart = {
        "type": "bitmap",
        "bitmap": mi.Bitmap(red_green),
        "raw": True,
        "filter_type": "bilinear",
        # From texel centre to texel centre, so that the colour is linear over all of the chart.
        "to_uv": T().translate([0.25, 0.25, 0]) @ T().scale([0.5, 0.5, 1]),
    }
    behind = T().translate([0, 0, -400]) @ T().scale(1000)
    return {
        "type": "scene",
        # At most one reflection at the glass: in and out again is three segments, with one reflection inside four.
        "integrator": {"type": "path", "max_depth": 4, "rr_depth": 100},
        "ball": {
            "type": "sphere",
            "center": [0, 0, 0],
            "radius": 100.0,
            "bsdf": {"type": "dielectric", "int_ior": ior, "ext_ior": 1.0},
        },
        "chart": rectangle(behind, bsdf=matte(0.0), emitter={"type": "area", "radiance": chart}),
        "surroundings": {"type": "constant", "radiance": rgb(0.2, 0.4, 0.6)},
    }


def sky(direction):
    """Radiance from a unit direction: red has a broad bright side, blue a narrow one, green is uniform."""
    sun = np.array([1, 2, 2]) / 3
    window = np.array([-2, 1, 2]) / 3
    red = 0.3 + 0.2 * direction[..., 1] + 3 * np.maximum(direction @ sun, 0) ** 4
    green = np.ones_like(red)
    blue = 0.1 + 5 * np.maximum(direction @ window, 0) ** 16
    return np.stack([red, green, blue], axis=-1)


def balls_under_a_sky():
    """A matt ball and two of metal, so far apart that they are alone."""
    width, height = 1024, 512
    # Mitsuba's map has -Z at its edges and +X at a quarter. Texel centres lie at +.5 across, but the first and last rows
    # lie on the poles.
    angle = (np.arange(width) + 0.5) / width * 2 * np.pi
    from_top = (np.arange(height) / (height - 1) * np.pi)[:, None]
    x, y, z = np.sin(angle) * np.sin(from_top), np.cos(from_top) + 0 * angle, -np.cos(angle) * np.sin(from_top)
    texels = sky(np.stack([x, y, z], axis=-1)).astype(np.float32)
    scene = {
        "type": "scene",
        "integrator": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 1},
        "sky": {"type": "envmap", "bitmap": mi.Bitmap(texels)},
    }
    metal = {"type": "principled", "metallic": 1.0, "base_color": gray(0.8)}
    surfaces = {
        -1000: {"type": "diffuse", "reflectance": gray(0.5)},
        0: {**metal, "roughness": 0.2},
        1000: {**metal, "roughness": 0.4},
    }
    for x, surface in surfaces.items():
        scene[f"ball at {x}"] = {"type": "sphere", "center": [x, 0, 0], "radius": 1.0, "bsdf": surface}
    return scene


def measure(name, scene, eye, points, samples):
    for point in points:
        scene["sensor"] = {
            "type": "radiancemeter",
            "origin": list(eye),
            "direction": [p - e for p, e in zip(point, eye)],
            "film": {
                "type": "hdrfilm",
                "width": 1,
                "height": 1,
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": "independent", "sample_count": min(samples, RUN)},
        }
        loaded = mi.load_dict(scene)
        runs = max(samples // RUN, 1)
        means = np.array([np.array(mi.render(loaded, seed=run + 1)).reshape(3) for run in range(runs)], dtype=float)
        mean = means.mean(axis=0)
        error = means.std(axis=0, ddof=1).max() / np.sqrt(runs) if runs > 1 else 0.0
        place = ", ".join(f"{p:g}" for p in point)
        print(f"{name}: {{{place}}} {{{mean[0]:.6g}, {mean[1]:.6g}, {mean[2]:.6g}}} +- {error:.1e}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=1 << 22, help="per ray, except under a point light: one")
    samples = parser.parse_args().samples
    print("Mitsuba", mi.__version__)

    above = [(x, 0, 0.3) for x in (0, 0.5, 1, 2, 4, -3)]
    measure("lamp 2 m above", lit_floor(lamp([0, 2, 0], 0, 0.5)), (0, 1, 4), above, samples)
    measure("lamp near and tilted", lit_floor(lamp([0, 0.8, 0], 40, 0.5)), (0, 0.3, 4), above, samples)

    blocker = rectangle(T().translate([0.1, 1, 0]) @ DOWN @ T().scale(0.4), bsdf=matte(0.0))
    line = [(round(-1.4 + 0.2 * i, 3), 0, 0.15) for i in range(17)]
    measure("penumbra", lit_floor(lamp([0, 2, 0], 0, 0.5), blocker=blocker), (0, 0.6, 4), line, samples)

    gold = (1.0, 0.77, 0.34)
    steep = [(0, 0, 2), (0, 0, 1.8), (0, 0, 2.3), (0.3, 0, 2), (0.5, 0, 1.5)]
    for roughness in (0.2, 0.3):
        measure(f"metal {roughness} steep", metal_floor(roughness, [0, 2, 0], gold), (0, 2, 4), steep, 1)
        measure(f"metal {roughness} flat", metal_floor(roughness, [0, 0.5, 0], gold), (0, 0.5, 4), steep, 1)

    # Through the plane of the ball's centre, at a slant so that red and green differ.
    ball = [(80 * b, 60 * b, 0) for b in (0, 0.2, 0.4, 0.6, 0.75, 0.85, 0.93, 1.0, 1.2)]
    for ior in (1.5, 1.33):
        measure(f"glass {ior}", glass_ball(ior), (0, 0, 400), ball, samples)

    on_sky = [(500 + 4 * a, 4 * b, 4 + c) for a, b, c in ((1, 0, -1), (-1, 2, -1), (1, 2, 2), (-2, 1, 2), (0, -3, 1))]
    measure("sky", balls_under_a_sky(), (500, 0, 4), on_sky, samples)
    on_ball = ((0, 0), (0.4, 0.3), (-0.5, 0.5), (0.2, -0.7), (-0.8, 0.1), (0.3, 0.85))
    for name, x in (("matt ball", -1000), ("smooth metal ball", 0), ("rough metal ball", 1000)):
        measure(name, balls_under_a_sky(), (x, 0, 4), [(x + a, b, 0) for a, b in on_ball], samples)


if __name__ == "__main__":
    main()
