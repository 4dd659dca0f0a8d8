"""Opens the views of a finished run in ParaView and looks whether they hold what report.json says: pvpython open_views.py RUN"""
import json
import os
import sys

from paraview.simple import OpenDataFile, UpdatePipeline, XDMFReader
from paraview import servermanager

run = sys.argv[1]
with open(os.path.join(run, "report", "report.json")) as file:
    report = json.load(file)
finished = [e["index"] for e in report["episodes"] if (e["tracer"] or {}).get("state") == "finished"]
assert finished, "no finished tracer stage"


def open_view(name):
    reader = OpenDataFile(os.path.join(run, "fields", name + ".xdmf"))
    assert reader is not None, name + " is not opened"
    times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__iter__") else [reader.TimestepValues]
    assert times == finished, f"{name}: time steps {times} instead of {finished}"
    return reader


def at(reader, time):
    UpdatePipeline(time=time, proxy=reader)
    data = servermanager.Fetch(reader)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return data


def values(arrays, name):
    array = arrays.GetArray(name)
    assert array is not None, f"{name} is missing"
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


tracer_fields, dem_fields = open_view("tracer_fields"), open_view("dem_fields")
tracers, parcels = open_view("tracers"), open_view("parcels")
for index in finished:
    episode = next(e for e in report["episodes"] if e["index"] == index)
    mesh = at(tracer_fields, index)
    assert mesh.GetNumberOfCells() == episode["tracer"]["cells"], "cells of the tracer stage"
    assert mesh.GetCellType(0) == 12, "hexahedra"
    temperature = [t for (t,) in values(mesh.GetCellData(), "solids_temperature")]
    assert 250 < min(temperature) and max(temperature) < 3000, "temperatures"
    assert len(values(mesh.GetCellData(), "solids_velocity")[0]) == 3, "velocity is a vector"
    assert at(dem_fields, index).GetNumberOfCells() == episode["dem"]["cells"], "cells of the DEM stage"
    points = at(tracers, index)
    assert points.GetNumberOfPoints() == episode["tracer"]["tracers"], "tracers"
    assert points.GetNumberOfCells() == points.GetNumberOfPoints(), "each tracer is a cell: only cells are drawn"
    assert len(values(points.GetPointData(), "temperature")) == points.GetNumberOfPoints(), "temperatures of tracers"
    packing = at(parcels, index)
    assert packing.GetNumberOfPoints() == episode["dem"]["parcels"], "parcels"
    assert packing.GetNumberOfCells() == packing.GetNumberOfPoints(), "each parcel is a cell"
    radii = [r for (r,) in values(packing.GetPointData(), "radius")]
    assert 0 < min(radii) and max(radii) < 1, "radii"
    box = mesh.GetBounds()
    assert all(low - 1 < low_point and high_point < high + 1 for low, high, low_point, high_point in
               zip(box[0::2], box[1::2], points.GetBounds()[0::2], points.GetBounds()[1::2])), "tracers lie in the mesh"
# ParaView asks which of its readers to take: the older one shows the same.
for name, kind, count in (("tracers", "tracer", "tracers"), ("parcels", "dem", "parcels"), ("dem_fields", "dem", "cells")):
    older = XDMFReader(FileNames=[os.path.join(run, "fields", name + ".xdmf")])
    for index in finished:
        episode = next(e for e in report["episodes"] if e["index"] == index)
        UpdatePipeline(time=index, proxy=older)
        assert older.GetDataInformation().GetNumberOfCells() == episode[kind][count], f"{name} in the older reader"
result = OpenDataFile(os.path.join(run, "episodes", f"{finished[-1]:03d}", "tracer", "attempt-1", "result.hdf"))
assert at(result, 0).GetNumberOfCells() == report["episodes"][-1]["tracer"]["cells"], "result.hdf opens as it is"
print(f"ParaView shows {len(finished)} episodes: fields, tracers, parcels")
