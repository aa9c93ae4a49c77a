FLAT = """
robot_start = [1, 1, 0]
person = [2, 2, 180]
rooms = [{ name = "den", kind = "LivingRoom", rectangle = [0, 0, 5, 5] }]
doors = [{ position = [2, 0], width = 1 }]

[[furniture]]
name = "desk"
kind = "Desk"
room = "den"
pose = [3, 4, -90]
size = [0.6, 1.2, 0.7]

[[furniture]]
name = "rack"
kind = "Shelf"
room = "den"
pose = [0.5, 3, 0]
size = [0.4, 1, 1]
boards = [0.4]

[delivery]
name = "delivery"
kind = "Table"
room = "den"
pose = [4, 1, 90]
size = [0.4, 0.4, 0.6]

[objects]
mug = "desk"
"""
