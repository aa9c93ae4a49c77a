"""Sound for the ears: 16,000 samples per second, 16 bits, one channel; reading and writing WAV."""

import io
import wave
from math import gcd
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from executive.errors import InputError

Sound = NDArray[np.int16]
"""(n,) samples at `RATE_HZ`, one channel."""

RATE_HZ = 16_000
LONGEST_S = 60.0
"""The longest sound in a file (s); a longer one is no command: nobody speaks so long at a time."""
RIGHT = "record WAV, 16 bits, 16 kHz, one channel: arecord -f S16_LE -r 16000 -c 1 FILE.wav"
SLOWEST_HZ, FASTEST_HZ = 8_000, 192_000
MOST_BYTES = 100 << 20
"""The largest file (bytes): a minute of high-quality stereo is smaller."""
EXTENSIBLE = b"\xfe\xff"
FLOOR = 3.0
"""Standard deviation of an inaudible noise (full scale is 32,767)."""
QUIET = 100
"""A peak below this (of 32,767) is silence: the noise of microphones is lower."""


def read_wav(path: Path) -> Sound:
    """Read a WAV file.

    Other rates are resampled to 16 kHz, several channels are averaged, and samples of 8, 24 or 32
    bits are converted to 16.

    Raises:
        InputError: if it cannot be read, is not such a WAV, has no sound, or is longer than a
            minute or larger than 100 MB.
    """
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise InputError(str(path), error.strerror or "cannot be read", RIGHT) from None
    if len(content) > MOST_BYTES:
        raise InputError(str(path), f"is larger than {MOST_BYTES >> 20} MB", RIGHT)
    return from_wav(content, str(path))


def from_wav(content: bytes, where: str) -> Sound:
    """The sound in the content of a WAV file.

    The length in the header may be too large, as a program that writes into a pipe does not know
    it; then the samples that are there count.

    Raises:
        InputError: as `read_wav` does.
    """
    try:
        with wave.open(io.BytesIO(_with_plain_format(content))) as file:
            width, channels, rate = file.getsampwidth(), file.getnchannels(), file.getframerate()
            if not 1 <= width <= 4:
                raise InputError(where, f"has samples of {8 * width} bits", RIGHT)
            if not SLOWEST_HZ <= rate <= FASTEST_HZ:
                raise InputError(where, f"has {rate:,} samples a second", RIGHT)
            frames = file.readframes(int(rate * LONGEST_S) + 1)
    except (wave.Error, EOFError, RuntimeError, ValueError) as error:  # of a broken header
        other = "unknown format" in str(error)
        what = "is a WAV file whose samples are no whole numbers" if other else "is no WAV file"
        raise InputError(where, what, RIGHT) from None
    samples = _of_16_bits(frames[: len(frames) // (width * channels) * width * channels], width)
    if not len(samples):
        raise InputError(where, "has no sound in it", RIGHT)
    if len(samples) / channels > rate * LONGEST_S:
        raise InputError(where, f"is longer than {LONGEST_S:.0f} s", "give one command a file")
    return resampled(samples.reshape(-1, channels).mean(axis=1), rate)


def _with_plain_format(content: bytes) -> bytes:
    """Replace the extensible format tag by the plain one that it contains."""
    at = content.find(b"fmt ", 0, 1000) + 8
    if at < 8 or content[at : at + 2] != EXTENSIBLE or len(content) < at + 26:
        return content
    return content[:at] + content[at + 24 : at + 26] + content[at + 2 :]


def _of_16_bits(frames: bytes, width: int) -> NDArray[np.float64]:
    """Samples of `width` bytes, scaled to the range of 16 bits."""
    if width == 1:
        return (np.frombuffer(frames, np.uint8).astype(np.float64) - 128.0) * 256.0
    padded = np.zeros((len(frames) // width, 4), np.uint8)
    padded[:, 4 - width :] = np.frombuffer(frames, np.uint8).reshape(-1, width)
    return padded.view("<i4")[:, 0] / 65536.0


def resampled(samples: NDArray[np.floating], rate_hz: int) -> Sound:
    """Resample to 16 kHz, and round and clip to 16 bits."""
    if rate_hz != RATE_HZ and len(samples):
        from scipy.signal import resample_poly  # slow to import

        common = gcd(rate_hz, RATE_HZ)
        samples = resample_poly(samples, RATE_HZ // common, rate_hz // common)
    return np.clip(np.round(samples), -32768, 32767).astype(np.int16)


def to_wav(sound: Sound) -> bytes:
    """The content of a WAV file."""
    content = io.BytesIO()
    with wave.open(content, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE_HZ)
        file.writeframes(sound.astype("<i2").tobytes())
    return content.getvalue()


def with_floor(sound: Sound) -> Sound:
    """Add an inaudible noise: recognisers have trouble with digital silence."""
    noise = np.random.default_rng(0).normal(0, FLOOR, len(sound))
    return np.clip(np.round(sound + noise), -32768, 32767).astype(np.int16)


def is_silent(sound: Sound) -> bool:
    """Whether the sound is silence."""
    return not len(sound) or int(np.abs(sound.astype(np.int32)).max()) < QUIET
