"""Writers of the files of profilometers, byte by byte, for the tests of the readers."""

from __future__ import annotations

import hashlib
import io
import struct
import zipfile
from typing import Any

import numpy as np
from scenes import Array

# ISO 25178-71, data types: code, letter of struct, and the least number, which means not measured.
SDF_TYPES = {
    "int8": (4, "b", -128),
    "int16": (5, "h", -32768),
    "int32": (6, "i", -2147483648),
    "float": (3, "f", -3.4028234663852886e38),
    "double": (7, "d", -1.7976931348623157e308),
}


def sdf(
    heights: Array, x_step: float, z_step: float, kind: str = "double", revision: int = 1, **codes: int
) -> bytes:
    """Writes a binary SDF file: ISO 25178-71, Table 2. Lengths are in metres."""
    rows, count = heights.shape
    code, letter, least = SDF_TYPES[kind]
    counts = struct.pack("<HH" if revision == 1 else "<II", count, rows)
    header = (
        f"bISO-{revision}.0".encode()  # version, 8 bytes
        + b"tests     "  # ManufacID, 10 bytes
        + b"261120261450" * 2  # CreateDate and ModDate, DDMMYYYYHHMM
        + counts  # NumPoints, NumProfiles
        + struct.pack("<dddd", x_step, 2 * x_step, z_step, -1.0)  # Xscale, Yscale, Zscale, Zresolution
        + struct.pack("<BBB", codes.get("compression", 0), codes.get("code", code), codes.get("check", 0))
    )
    assert len(header) == (81 if revision == 1 else 85)
    data = b""
    for height in heights.ravel():
        stored = height / z_step
        whole = stored if letter in "fd" else round(stored) if np.isfinite(stored) else 0
        data += struct.pack(f"<{letter}", least if np.isnan(height) else whole)
    return header + data


def sdf_text(heights: Array, x_step: float, z_step: float, end: str = "\r\n") -> str:
    """Writes an SDF file in ASCII: a line for each field, and records that end with an asterisk."""
    rows, count = heights.shape
    fields = {
        "ManufacID": "tests",
        "CreateDate": "261120261450",
        "ModDate": "261120261450",
        "NumPoints": count,
        "NumProfiles": rows,
        "Xscale": f"{x_step:.14e}",
        "Yscale": f"{2 * x_step:.14e}",
        "Zscale": f"{z_step:.14e}",
        "Zresolution": "-1.0",
        "Compression": 0,
        "DataType": 7,
        "CheckType": 0,
    }
    words = ["BAD" if np.isnan(height) else f"{height / z_step:.16e}" for height in heights.ravel()]
    lines = ["aISO-1.0", *(f"{name} = {value}" for name, value in fields.items()), "*"]
    lines += [" ".join(words[at : at + 5]) for at in range(0, len(words), 5)]
    return end.join([*lines, "*", "OperatorName = nobody", "*", ""])


X3P_TYPES = {"I": "h", "L": "i", "F": "f", "D": "d"}

MAIN = """<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>{feature}</FeatureType>
    <Axes>
      <CX>
        <AxisType>{x_type}</AxisType><DataType>D</DataType>
        <Increment>{x_step!r}</Increment><Offset>{x_offset!r}</Offset>
      </CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>1e-06</Increment><Offset>0.0</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>{kind}</DataType><Increment>{z_step!r}</Increment><Offset>0.0</Offset></CZ>
    </Axes>
  </Record1>
  <Record2>
    <Date>2026-11-20T14:50:00.0+01:00</Date>
    <Creator>tests</Creator>
    <Instrument>
      <Manufacturer>none</Manufacturer><Model>none</Model><Serial>none</Serial><Version>none</Version>
    </Instrument>
    <CalibrationDate>2026-11-20T14:50:00.0+01:00</CalibrationDate>
    <ProbingSystem><Type>Contacting</Type><Identification>none</Identification></ProbingSystem>
  </Record2>
  <Record3>
    <MatrixDimension><SizeX>{count}</SizeX><SizeY>{rows}</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink>
      <PointDataLink>bindata/data.bin</PointDataLink>
      <MD5ChecksumPointData>{checksum}</MD5ChecksumPointData>{valid}
    </DataLink>
  </Record3>
  <Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>
</p:ISO5436_2>
"""


def x3p(
    heights: Array, x_step: float, z_step: float = 1.0, kind: str = "D", x: Array | None = None, **given: Any
) -> bytes:
    """Writes an X3P file, ISO 25178-72: main.xml, the points x fastest, and bits of valid points.

    Lengths are in metres. Given `x` are stored, as of an absolute axis.
    """
    rows, count = heights.shape
    data, link = b"", ""
    for at, height in enumerate(heights.ravel()):
        stored = height / z_step
        data += b"" if x is None else struct.pack("<d", x[at % count])
        whole = stored if kind in "FD" else round(stored) if np.isfinite(stored) else 0
        data += struct.pack(f"<{X3P_TYPES[kind]}", whole)
    parts = {"bindata/data.bin": data}
    if kind in "IL":
        bits = bytearray(-(-heights.size // 8))
        for at, height in enumerate(heights.ravel()):
            bits[at // 8] |= int(np.isfinite(height)) << at % 8
        parts["bindata/valid.bin"] = bytes(bits)
        digest = hashlib.md5(bits).hexdigest()
        link = "\n<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"
        link += f"<MD5ChecksumValidPoints>{digest}</MD5ChecksumValidPoints>"
    fields = {
        "feature": "PRF" if rows == 1 else "SUR",
        "x_type": "I" if x is None else "A",
        "x_step": x_step,
        "x_offset": 0.0,
        "kind": kind,
        "z_step": z_step,
        "count": count,
        "rows": rows,
        "checksum": hashlib.md5(data).hexdigest(),
        "valid": link,
    }
    main = MAIN.format(**{**fields, **given}).encode()
    checksum = hashlib.md5(main).hexdigest().encode() + b" *main.xml\n"
    return packed({"main.xml": main, "md5checksum.hex": checksum, **parts})


def packed(parts: dict[str, bytes]) -> bytes:
    """Packs parts into an archive."""
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as of:
        for name, content in parts.items():
            of.writestr(name, content)
    return archive.getvalue()
