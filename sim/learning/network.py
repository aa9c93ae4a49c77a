"""The detector's network: single-shot, anchor-free, convolutions only.

It has feature maps at an eighth and a sixteenth of the picture's resolution. Each cell predicts the
class of the object at its centre, and the distances to the edges of its box. The sides of pictures
must be multiples of 16.
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
    """Two convolutions, with half as many channels between them, and a skip connection.

    It is the identity at first (Goyal et al., arXiv:1706.02677), so that more of them can be added
    to a trained network.
    """

    def __init__(self, channels: int) -> None:
        """Keep the number of channels."""
        super().__init__()
        last = Block(channels // 2, channels)
        nn.init.zeros_(last[1].weight)
        self.way = nn.Sequential(Block(channels, channels // 2), last)

    def forward(self, x: Tensor) -> Tensor:
        """Add the output of the convolutions to the input."""
        return x + self.way(x)


class Surroundings(nn.Module):
    """Spatial pyramid pooling, with windows of 5, 9 and 13 cells."""

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
    """Backbone, a top-down path, and two heads."""

    def __init__(self, classes: int) -> None:
        """Make a network for this number of classes."""
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

        The first four channels are the distances from the centre of the cell to left, top, right
        and bottom of the box, in strides, before softplus; then the logits of the classes.
        """
        fine = self.eighth(self.quarter(pictures))
        coarse = self.sixteenth(fine)
        wide = functional.interpolate(self.up(coarse), scale_factor=2.0, mode="nearest")
        return [self.heads[0](self.fuse(fine + wide)), self.heads[1](coarse)]


def cells(height: int, width: int) -> tuple[Tensor, Tensor]:
    """Centres (n, 2; x and y in pixels) and strides (n, 1) of all cells of a picture."""
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
    """Boxes (b, n, 4; left, top, right, bottom in pixels)."""
    low = middles - distances[..., :2] * strides
    high = middles + distances[..., 2:] * strides
    return torch.cat((low, high), -1)


class Exported(nn.Module):
    """The network for export, with YOLOv8's output (1, 4 + classes, n).

    The channels are centre x and y, width and height in pixels, then the classes' probabilities.
    """

    def __init__(self, network: Network, height: int, width: int) -> None:
        """Wrap a network for pictures of one size (pixels)."""
        super().__init__()
        self.network = network
        middles, strides = cells(height, width)
        self.register_buffer("middles", middles.T[None])
        self.register_buffer("strides", strides.T[None])

    def forward(self, pictures: Tensor) -> Tensor:
        """Detect in a picture (1, 3, h, w) in [0, 1]."""
        rows = torch.cat([one.flatten(2) for one in self.network(pictures)], 2)
        distances = functional.softplus(rows[:, :4]) * self.strides
        low, high = distances[:, :2], distances[:, 2:]
        middle = self.middles + (high - low) / 2
        return torch.cat((middle, low + high, rows[:, 4:].sigmoid()), 1)
