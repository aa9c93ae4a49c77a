"""Builds packages of messages that the wheels of ROS 2 lack, into the environment that runs this.

Usage: PYTHON interfaces.py FOLDER... where each folder has the package's name, and its msg/, srv/
and action/. A package that needs another one comes after it. It needs g++ and Python's headers.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy
from rosidl_adapter import convert_to_idl
from rosidl_generator_c.cli import GenerateC
from rosidl_generator_py.cli import GeneratePython
from rosidl_generator_type_description.cli import HashTypeDescription
from rosidl_typesupport_c.cli import GenerateCTypesupport
from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport
from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport

PREFIX, PACKAGES = Path(sys.prefix), Path(sysconfig.get_path("purelib"))
SHARE, LIBRARIES, INCLUDE = PREFIX / "share", PREFIX / "lib", PREFIX / "include"
SUPPORTS = ["rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c"]
CODE = "__rosidl_generator_py"
"""How the library is called in which others look for a package's conversions."""
NEEDED = (
    f"lib*{CODE}.so",
    "lib*_msgs__rosidl_*_c.so",
    "lib*_interfaces__rosidl_*_c.so",
    "librosidl_*.so",
    "libfastcdr.so",
    "librcutils.so",
    "librmw.so",
)
"""Libraries that the code of messages may call."""


class Package:
    """One package, made in a folder that is thrown away."""

    def __init__(self, source: Path, folder: Path) -> None:
        self.source, self.name = source, source.name
        self.made = folder / "made" / source.name
        self.apart = folder / "apart" / source.name
        """Of files that have the same names as others."""
        self.objects = folder / "objects"
        self.objects.mkdir()

    def build(self) -> None:
        """Make all that Python needs of it."""
        self.generate()
        self.compile()
        for kind in ("msg", "srv", "action"):
            copy((self.made / kind).glob("*.idl"), SHARE / self.name / kind)
            copy((self.made / kind).glob("*.json"), SHARE / self.name / kind)
            headers = INCLUDE / self.name / self.name / kind
            for made in (self.made, self.apart):
                copy((made / kind).glob("*.h"), headers)
                copy((made / kind / "detail").glob("*.h"), headers / "detail")
        shutil.copytree(self.made, PACKAGES / self.name, dirs_exist_ok=True)

    def generate(self) -> None:
        """Write the code, in C, C++ and Python."""
        files = [file.relative_to(self.source) for file in sorted(self.source.glob("*/*.*"))]
        for file in files:
            convert_to_idl(self.source, self.name, file, self.made)
        idl = [f"{self.made}:{file.with_suffix('.idl')}" for file in files]
        given = (self.name, idl, [str(SHARE)], self.made)
        hashes = HashTypeDescription("hash").generate_type_hashes(*given)
        GenerateC("c").generate(*given, type_description_files=hashes)
        GenerateFastRTPSCTypesupport("fastrtps_c").generate(*given)
        GenerateIntrospectionCTypesupport("introspection_c").generate(*given[:3], self.apart)
        GenerateCTypesupport("c", typesupport_implementations=SUPPORTS).generate(*given)
        kinds = ["rosidl_typesupport_c", *SUPPORTS]
        GeneratePython("py", typesupport_implementations=kinds).generate(*given)

    def compile(self) -> None:
        """Make the library of the messages, and the modules that Python imports."""
        modules = sorted(self.made.glob(f"_{self.name}_s.ep.*.c"))
        files = [f for made in (self.made, self.apart) for f in sorted(made.rglob("*.c*"))]
        with ThreadPoolExecutor(os.cpu_count()) as workers:
            objects = dict(zip(files, workers.map(self.compiled, files), strict=True))
        found = [lib for pattern in NEEDED for lib in LIBRARIES.glob(pattern)]
        link = [f"-L{LIBRARIES}", *(f"-l:{lib.name}" for lib in found)]
        code = LIBRARIES / f"lib{self.name}{CODE}.so"
        built = [str(made) for file, made in objects.items() if file not in modules]
        run("g++", "-shared", "-o", str(code), *built, *link)
        for support in SUPPORTS:  # where they are looked for at run time
            (LIBRARIES / f"lib{self.name}__{support}.so").symlink_to(code.name)
        for module in modules:
            support = module.suffixes[-2].removeprefix(".")
            into = self.made / f"{self.name}_s__{support}.so"
            run("g++", "-shared", "-o", str(into), str(objects[module]), str(code), *link)

    def compiled(self, file: Path) -> Path:
        """The object of one file of C or C++."""
        into = self.objects / f"{file.parts[-3]}.{file.name}.{'apart' in file.parts}.o"
        folders = [self.made.parent, self.apart.parent, INCLUDE, *INCLUDE.iterdir()]
        python = [sysconfig.get_path("include"), numpy.get_include()]
        include = [f"-I{folder}" for folder in (*folders, *python)]
        compiler = ["gcc", "-std=gnu11"] if file.suffix == ".c" else ["g++", "-std=c++17"]
        run(*compiler, "-fPIC", "-w", "-c", str(file), "-o", str(into), *include)
        return into


def run(*command: str) -> None:
    subprocess.run(command, check=True)


def copy(files: Iterable[Path], folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for file in files:
        shutil.copy(file, folder)


if __name__ == "__main__":
    os.environ["AMENT_PREFIX_PATH"] = sys.prefix
    for argument in sys.argv[1:]:
        with tempfile.TemporaryDirectory() as temporary:
            Package(Path(argument).resolve(), Path(temporary)).build()
