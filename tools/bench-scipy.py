#!/usr/bin/env python3
"""bench-scipy.py -- the exhaustive search of osdtex-bench, in numpy and scipy.

    bench-scipy.py PROBLEM TURNS WORKERS

PROBLEM is what osdtex/bench/bench_scipy.c writes: the exemplar and the mask at
every orientation. For each the masked sum of squared differences to all
translations is formed through Fourier space, in single precision; the spectra
of the exemplar are made once, beforehand. Prints the best match and the best
of TURNS times: processor time with one worker, wall time with WORKERS.
"""
import json
import sys
import time

import numpy as np
from scipy import fft


def read_problem(path):
    with open(path, "rb") as file:
        n, channels, angles = np.fromfile(file, np.int32, 3)
        exemplar = np.fromfile(file, np.float32, n * n * channels)
        masks = []
        for _ in range(angles):
            base = np.fromfile(file, np.int32, 2)
            planes = np.fromfile(file, np.float32, (channels + 1) * n * n)
            masks.append((base, planes.reshape(channels + 1, n, n)))
    exemplar = exemplar.reshape(n, n, channels).transpose(2, 0, 1)
    # Differences do not see the mean, and single precision is finer without.
    mean = exemplar.mean(axis=(1, 2), dtype=np.float64).astype(np.float32)
    for _, planes in masks:
        planes[:-1] -= mean[:, None, None] * planes[-1]
    return exemplar - mean[:, None, None], masks


def make_spectra(exemplar):
    """-2 T for each channel, and the sum of T^2, conjugated: the mask moves."""
    planes = np.concatenate([-2 * exemplar, (exemplar**2).sum(0)[None]])
    return fft.rfft2(planes.astype(np.float32))


def search(spectra, masks, constants, workers):
    best = (np.inf, 0, 0, 0)
    for angle, (base, planes) in enumerate(masks):
        product = spectra * np.conj(fft.rfft2(planes, workers=workers))
        error = fft.irfft2(product.sum(0), planes.shape[1:], workers=workers)
        at = int(error.argmin())
        energy, weight = constants[angle]
        value = (energy + float(error.flat[at])) / weight
        if value < best[0]:
            y, x = divmod(at, error.shape[1])
            best = (value, angle, x - int(base[0]), y - int(base[1]))
    return best


def best_time(clock, turns, job):
    times = []
    for _ in range(turns):
        start = clock()
        job()
        times.append(clock() - start)
    return min(times)


def main():
    turns, workers = int(sys.argv[2]), int(sys.argv[3])
    exemplar, masks = read_problem(sys.argv[1])
    spectra = make_spectra(exemplar)
    # Weights are 1 where the mask is: the square of a weighted colour over
    # its weight is the weighted square.
    constants = []
    for _, planes in masks:
        weight = np.where(planes[-1] > 0, planes[-1], 1)
        energy = (planes[:-1].astype(np.float64) ** 2 / weight).sum()
        constants.append((energy, planes[-1].sum(dtype=np.float64)))
    value, angle, x, y = search(spectra, masks, constants, 1)
    answer = {
        "angle": angle,
        "x": x,
        "y": y,
        "error": value,
        "cpu": best_time(
            time.process_time, turns,
            lambda: search(spectra, masks, constants, 1)),
        "wall": best_time(
            time.perf_counter, turns,
            lambda: search(spectra, masks, constants, workers)),
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
