"""Meshes of boxes, cans and bottles, which differ mainly in their print."""

import numpy as np

from executive.geometry import Floats
from sim.modelling.parts import Part, box, cap, lathe, loft, ring, solid
from sim.modelling.skins import Label, brushed, mottled, plain

_TIN = ("#9a9fa4", "#d4d7da", "#b4b9be")


def cracker_box() -> list[Part]:
    """Red with a plate of crackers."""
    red, cream = "#c01f26", "#f7e7c4"
    front = Label(158, 210, red).rectangle(0, 0, 158, 22, "#8e1218")
    front.ellipse(79, 62, 140, 62, cream).text(79, 62, "CRACKERS", 116, red)
    for x, y in ((44, 128), (82, 120), (120, 132), (60, 166), (100, 168)):
        front.rectangle(x - 20, y - 20, x + 20, y + 20, "#8a4a1a")
        front.rectangle(x - 19, y - 19, x + 18, y + 18, "#dba04e")
        for dx in (-10, 0, 10):
            for dy in (-10, 0, 10):
                front.ellipse(x + dx, y + dy, 3, 3, "#8a4a1a")
    front.rectangle(0, 196, 158, 210, "#f1c232").text(79, 203, "CRISPY · SALTED · 454 g", 110, red)
    side = Label(60, 210, red).rectangle(5, 90, 55, 190, cream)
    side.text(30, 50, "CRACKERS", 50, cream)
    for y in range(100, 186, 8):
        side.rectangle(10, y, 50 - y % 3 * 6, y + 2, "#4a3b2a")
    top = Label(158, 60, red).text(79, 30, "CRACKERS", 110, cream)
    return box((0.060, 0.158, 0.210), (0, 0, 0.105), front.image(), side.image(), top.image())


def sugar_box() -> list[Part]:
    """Yellow over white, with a blue band."""
    yellow, white, blue = "#efc11f", "#f4f1e6", "#27459b"
    front = Label(89, 175, white).rectangle(0, 0, 89, 104, yellow)
    front.rectangle(0, 104, 89, 110, blue).ellipse(44.5, 58, 80, 56, blue)
    front.text(44.5, 58, "SUGAR", 66, "#ffffff").text(44.5, 20, "PURE CANE", 56, blue)
    for x, y in ((26, 150), (44, 150), (62, 150), (35, 134), (53, 134)):
        front.rectangle(x - 8, y - 8, x + 8, y + 8, "#b9c4dc")
        front.rectangle(x - 7, y - 7, x + 5, y + 5, "#ffffff")
    side = Label(38, 175, white).rectangle(0, 0, 38, 104, yellow).rectangle(0, 104, 38, 110, blue)
    side.text(19, 60, "SUGAR", 32, blue)
    for y in range(118, 166, 6):
        side.rectangle(5, y, 33 - y % 4 * 3, y + 1.6, "#5a6680")
    top = Label(89, 38, yellow).text(44.5, 19, "SUGAR", 60, blue)
    return box((0.038, 0.089, 0.175), (0, 0, 0.0875), front.image(), side.image(), top.image())


def pudding_box() -> list[Part]:
    """Brown with a dessert glass."""
    brown, cream = "#5b321d", "#f4e6cf"
    front = Label(110, 89, brown).rectangle(0, 0, 110, 10, "#b5232c")
    front.ellipse(38, 34, 70, 34, cream).text(38, 34, "PUDDING", 58, brown)
    front.text(38, 62, "CHOCOLATE", 52, "#e9b872")
    front.polygon([(74, 46), (108, 46), (99, 76), (83, 76)], "#a86f44")
    front.ellipse(91, 46, 34, 12, "#8a5530").ellipse(91, 40, 20, 14, "#fff7ea")
    front.ellipse(91, 33, 7, 7, "#c8232c").rectangle(82, 76, 100, 79, "#e8ded0")
    side = Label(35, 89, brown).rectangle(0, 0, 35, 10, "#b5232c").rectangle(4, 30, 31, 80, cream)
    for y in range(35, 76, 6):
        side.rectangle(7, y, 28 - y % 4 * 3, y + 1.6, brown)
    top = Label(110, 35, brown).text(55, 18, "CHOCOLATE PUDDING", 96, cream)
    return box((0.035, 0.110, 0.089), (0, 0, 0.0445), front.image(), side.image(), top.image())


def potted_meat_can() -> list[Part]:
    """A flat blue tin with rounded corners."""
    blue, yellow = "#23408f", "#f2d24a"
    around = 265.0
    print_ = Label(around, 76, blue).rectangle(0, 64, around, 70, yellow)
    for middle in (0.0, around / 2, around):
        print_.text(middle, 20, "POTTED", 62, yellow).text(middle, 41, "MEAT", 58, "#ffffff")
        print_.ellipse(middle, 57, 46, 9, "#b5413a").text(middle, 57, "340 g", 18, "#ffffff")
    tin = mottled(_TIN, 97, 50, 20)
    metal = brushed(_TIN, 60, 10)
    sizes = ((0.046, 0.093, 0.0), (0.050, 0.097, 0.002), (0.050, 0.097, 0.004))
    foot = [ring(x, y, z, 0.4, 28) for x, y, z in sizes]
    head = [ring(x, y, 0.082 - z, 0.4, 28) for x, y, z in reversed(sizes)]
    body = loft([ring(0.0492, 0.0962, z, 0.4, 28) for z in (0.004, 0.078)], print_.image())
    lid = (
        Label(97, 50, "#c3c7cb")
        .ellipse(48, 25, 80, 36, "#aab0b5")
        .ellipse(48, 25, 77, 33, "#ced2d5")
    )
    lid.ellipse(72, 25, 22, 12, "#8b9197").ellipse(74, 25, 14, 7, "#ced2d5")
    return [
        loft(foot, metal),
        body,
        loft(head, metal),
        cap(foot[0], tin, up=False),
        cap(head[-1], lid.image()),
    ]


def tomato_soup_can() -> list[Part]:
    """Red over white with a round seal."""
    red, white, around = "#c4161c", "#f5f1e6", 207.0
    print_ = Label(around, 95, white).rectangle(0, 0, around, 48, red)
    for middle in (0.0, around / 2, around):
        print_.text(middle, 25, "TOMATO", 62, white).ellipse(middle, 48, 24, 24, "#d8b04a")
        print_.ellipse(middle, 48, 19, 19, red).ellipse(middle, 43, 9, 4, "#4f8a3a")
        print_.text(middle, 73, "SOUP", 46, red)
    metal = brushed(_TIN, 60, 8)
    lid = Label(66, 66, "#c3c7cb")
    for width, ink in ((60, "#9aa0a5"), (57, "#d0d4d7"), (44, "#a9afb4"), (42, "#ced2d5")):
        lid.ellipse(33, 33, width, width, ink)
    foot = [ring(d, d, z) for d, z in ((0.064, 0), (0.066, 0.0015), (0.066, 0.003))]
    head = [ring(d, d, z) for d, z in ((0.066, 0.098), (0.066, 0.0995), (0.064, 0.101))]
    body = loft([ring(0.0652, 0.0652, z) for z in (0.003, 0.098)], print_.image())
    ends = [cap(foot[0], lid.image(), up=False), cap(head[-1], lid.image())]
    return [loft(foot, metal), body, loft(head, metal), *ends]


def mustard_bottle() -> list[Part]:
    """A squeezing bottle with a red label and a pale cap."""
    yellow, red, around = "#f0c010", "#a8231c", 250.0
    skin = Label(around, 150, yellow)
    for middle in (0.0, around / 2, around):
        skin.ellipse(middle, 92, 70, 62, red).ellipse(middle, 92, 64, 56, "#f7e9b5")
        skin.ellipse(middle, 92, 60, 52, red).text(middle, 86, "MUSTARD", 54, "#ffffff")
        skin.text(middle, 103, "YELLOW", 32, yellow)
    sizes = (
        (0.046, 0.080, 0.0),
        (0.050, 0.085, 0.004),
        (0.050, 0.085, 0.06),
        (0.050, 0.085, 0.116),
    )
    shoulders = ((0.047, 0.076, 0.126), (0.042, 0.060, 0.137), (0.030, 0.036, 0.143))
    body = [ring(x, y, z, 0.55) for x, y, z in (*sizes, *shoulders)]
    cream = mottled(("#d9d2bd", "#e8e2d0"), 88, 32, 10)
    return [
        *solid(body, skin.image(), plain(yellow)),
        lathe([(0.014, 0.143), (0.014, 0.157)], cream),
        cap(ring(0.028, 0.028, 0.157), cream),
        lathe([(0.009, 0.157), (0.005, 0.171), (0.005, 0.175), (0, 0.175)], cream, count=12),
    ]


def bleach_cleanser() -> list[Part]:
    """A tall white bottle with a blue label and cap."""
    white, blue, around = "#f2f2ee", "#2a5db0", 300.0
    skin = Label(around, 214, white)
    for middle in (0.0, around / 2, around):
        skin.rectangle(middle - 42, 88, middle + 42, 196, blue)
        skin.rectangle(middle - 42, 122, middle + 42, 158, "#ffffff")
        skin.text(middle, 140, "BLEACH", 74, "#c8232c").text(middle, 105, "CLEANSER", 64, "#ffffff")
        skin.text(middle, 171, "LEMON SCENT", 58, "#f6d743").rectangle(
            middle - 30, 182, middle + 30, 186, "#ffffff"
        )
    sizes = (
        (0.060, 0.092, 0.0),
        (0.065, 0.098, 0.005),
        (0.065, 0.098, 0.08),
        (0.065, 0.098, 0.162),
    )
    shoulders = ((0.060, 0.088, 0.176), (0.051, 0.066, 0.192), (0.036, 0.040, 0.206))
    body: list[Floats] = [ring(x, y, z, 0.5) for x, y, z in (*sizes, *shoulders)]
    ridges = Label(107, 44, blue)
    for x in np.arange(0.0, 107.0, 5.35):
        ridges.rectangle(x, 0, x + 1.6, 44, "#1d4384")
    return [
        *solid(body, skin.image(), plain(white)),
        lathe([(0.017, 0.206), (0.017, 0.250)], ridges.image()),
        cap(ring(0.034, 0.034, 0.250), plain(blue)),
    ]
