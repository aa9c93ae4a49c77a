"""The detector's network: single-shot, anchor-free, convolutions only.

Features at an eighth and a sixteenth of the picture; each cell of each says what is in its middle
and how far the edges of that thing's box are. It takes pictures of any size that 16 divides.
"""

import torch
from torch import Tensor, nn
from torch.nn import functional

STRIDES = (8, 16)


class Block(nn.Sequential):
    """Convolution, normalisation and SiLU."""

    def __init__(self, inputs: int, outputs: int, size: int = 3, stride: int = 1) -> None:
        """Keep the size of the picture, or divide it by the stride."""
        super().__init__(
            nn.Conv2d(inputs, outputs, size, stride, (size - stride + 1) // 2, bias=False),
            nn.BatchNorm2d(outputs),
            nn.SiLU(inplace=True),
        )


class Residual(nn.Module):
    """Two convolutions, with half as many channels between them, beside a straight way.

    It begins by changing nothing (Goyal et al., arXiv:1706.02677), so that a network which already
    knows something can be given more of them.
    """

    def __init__(self, channels: int) -> None:
        """Keep the number of channels."""
        super().__init__()
        last = Block(channels // 2, channels)
        nn.init.zeros_(last[1].weight)
        self.way = nn.Sequential(Block(channels, channels // 2), last)

    def forward(self, x: Tensor) -> Tensor:
        """Add what the convolutions find."""
        return x + self.way(x)


class Surroundings(nn.Module):
    """Spatial pyramid pooling: lets each cell know what is within 5, 9 and 13 cells."""

    def __init__(self, channels: int) -> None:
        """Keep the number of channels."""
        super().__init__()
        self.before = Block(channels, channels // 2, size=1)
        self.pool = nn.MaxPool2d(5, 1, 2)
        self.after = Block(2 * channels, channels, size=1)

    def forward(self, x: Tensor) -> Tensor:
        """Pool once, twice and three times."""
        pools = [self.before(x)]
        for _ in range(3):
            pools.append(self.pool(pools[-1]))
        return self.after(torch.cat(pools, 1))


class Network(nn.Module):
    """Backbone, a path back up, and two heads."""

    def __init__(self, classes: int) -> None:
        """Recognise so many classes."""
        super().__init__()
        self.quarter = nn.Sequential(Block(3, 32, size=6, stride=4), Residual(32))
        self.eighth = nn.Sequential(Block(32, 64, stride=2), Residual(64), Residual(64))
        self.sixteenth = nn.Sequential(
            Block(64, 128, stride=2), Residual(128), Residual(128), Surroundings(128)
        )
        self.up = Block(128, 64, size=1)
        self.fuse = Residual(64)
        self.heads = nn.ModuleList(
            nn.Sequential(Block(channels, channels), nn.Conv2d(channels, 4 + classes, 1))
            for channels in (64, 128)
        )
        for head in self.heads:
            nn.init.constant_(head[-1].bias[4:], -5.0)
            nn.init.constant_(head[-1].bias[:4], 1.0)

    def forward(self, pictures: Tensor) -> list[Tensor]:
        """For pictures (b, 3, h, w) in [0, 1]: per stride (b, 4 + classes, h / s, w / s).

        The first four are left, top, right, bottom of the box from the middle of the cell, in
        strides, before softplus; then the logits of the classes.
        """
        fine = self.eighth(self.quarter(pictures))
        coarse = self.sixteenth(fine)
        wide = functional.interpolate(self.up(coarse), scale_factor=2.0, mode="nearest")
        return [self.heads[0](self.fuse(fine + wide)), self.heads[1](coarse)]


def cells(height: int, width: int) -> tuple[Tensor, Tensor]:
    """Middles (n, 2; x and y in pixels) and strides (n, 1) of all cells of a picture this large."""
    middles, strides = [], []
    for stride in STRIDES:
        rows, columns = height // stride, width // stride
        y, x = torch.meshgrid(torch.arange(rows), torch.arange(columns), indexing="ij")
        middles.append((torch.stack((x, y), -1).reshape(-1, 2) + 0.5) * stride)
        strides.append(torch.full((rows * columns, 1), float(stride)))
    return torch.cat(middles), torch.cat(strides)


def flatten(maps: list[Tensor]) -> tuple[Tensor, Tensor]:
    """Distances in strides (b, n, 4) and logits (b, n, classes) of all cells."""
    rows = torch.cat([one.flatten(2) for one in maps], 2).transpose(1, 2)
    return functional.softplus(rows[..., :4]), rows[..., 4:]


def boxes_of(distances: Tensor, middles: Tensor, strides: Tensor) -> Tensor:
    """Left, top, right, bottom (b, n, 4; pixels)."""
    low = middles - distances[..., :2] * strides
    high = middles + distances[..., 2:] * strides
    return torch.cat((low, high), -1)


class Exported(nn.Module):
    """The network as an ONNX file has it: YOLOv8's output (1, 4 + classes, n).

    Middle x and y, width and height in pixels, then the probabilities of the classes.
    """

    def __init__(self, network: Network, height: int, width: int) -> None:
        """For pictures of one size."""
        super().__init__()
        self.network = network
        middles, strides = cells(height, width)
        self.register_buffer("middles", middles.T[None])
        self.register_buffer("strides", strides.T[None])

    def forward(self, pictures: Tensor) -> Tensor:
        """Recognise."""
        rows = torch.cat([one.flatten(2) for one in self.network(pictures)], 2)
        distances = functional.softplus(rows[:, :4]) * self.strides
        low, high = distances[:, :2], distances[:, 2:]
        middle = self.middles + (high - low) / 2
        return torch.cat((middle, low + high, rows[:, 4:].sigmoid()), 1)
