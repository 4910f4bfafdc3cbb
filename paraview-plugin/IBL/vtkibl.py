# SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
# SPDX-License-Identifier: BSD-3-Clause
"""Environment light for ParaView's Python, in one line. The plugin brings this module along:

    import vtkibl
    vtkibl.light("sky.exr")
"""
from paraview import simple


def light(file="", view=None, **properties):
    """Lights `view`, by default the active one, with the panorama in `file`, by default with the built-in studio.

    A render view of another kind is replaced by a "Render View (IBL)" that shows the same from the same camera, in the
    same place of the layout. `properties` are set on that, ShowEnvironment=1, say. Returns the lit view."""
    view = view or simple.GetActiveView() or simple.GetActiveViewOrCreate("IBLRenderView")
    if view.GetXMLName() != "IBLRenderView":
        view = _replace(view)
    view.EnvironmentFile = file
    for name, value in properties.items():
        setattr(view, name, value)
    view.StillRender()  # simple.Render() would move the camera of a new view
    return view


def _replace(old):
    if not old.IsA("vtkSMRenderViewProxy"):
        raise TypeError(f"{old.GetXMLLabel()} is not a render view; make one active, or give it as view=...")
    new = simple.CreateView("IBLRenderView")
    _copy(old, new, without=("Representations", "HiddenRepresentations", "HiddenProps", "UseLight"))
    for shown in list(old.Representations):
        if shown.GetProperty("Input"):  # a legend has none, and comes with what it is of
            _copy(shown, simple.Show(shown.Input, new), without=("Input",))
    layout = simple.GetLayout(old)
    place = layout.RemoveView(old.SMProxy) if layout else -1
    simple.Delete(old)
    if place >= 0:
        layout.AssignView(place, new)
    simple.SetActiveView(new)
    return new


def _copy(one, other, without):
    """Gives `other` the values of all properties that both have."""
    properties = one.SMProxy.NewPropertyIterator()
    while not properties.IsAtEnd():
        value, mine = properties.GetProperty(), other.SMProxy.GetProperty(properties.GetKey())
        if properties.GetKey() not in without and mine and not value.GetInformationOnly():
            mine.Copy(value)
        properties.Next()
    other.UpdateVTKObjects()
