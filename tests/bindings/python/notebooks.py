# SPDX-License-Identifier: BSD-3-Clause
"""Executes every notebook of a folder; each must end in a picture: notebooks.py FOLDER"""

import pathlib
import sys

try:
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbclient
    import nbformat
except ImportError as missing:
    print(f"skipped: {missing.name} is not installed")
    sys.exit(77)

found = sorted(pathlib.Path(sys.argv[1]).glob("*.ipynb"))
assert found, "expected notebooks"
for path in found:
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    for cell in notebook.cells:
        assert not cell.get("outputs"), f"{path.name}: expected a notebook without results; they are made when it is run"
    where = {"metadata": {"path": path.parent}}
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources=where).execute()
    last = [cell for cell in notebook.cells if cell.cell_type == "code"][-1]
    assert any("image/png" in output.get("data", {}) for output in last.outputs), f"{path.name}: expected a picture at its end"
    print(path.name, "runs")
