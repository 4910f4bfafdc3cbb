// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIBLProbeCollection.h"

#include "vtkIBLProbe.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkIBLProbeCollection);

void vtkIBLProbeCollection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FaceSize: " << this->FaceSize << "\n"
     << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
}

void vtkIBLProbeCollection::AddItem(vtkIBLProbe* probe)
{
  this->Superclass::AddItem(probe);
}

vtkIBLProbe* vtkIBLProbeCollection::GetNextProbe(vtkCollectionSimpleIterator& cookie)
{
  return static_cast<vtkIBLProbe*>(this->GetNextItemAsObject(cookie));
}

vtkIBLProbe* vtkIBLProbeCollection::GetProbe(int index)
{
  return static_cast<vtkIBLProbe*>(this->GetItemAsObject(index));
}

void vtkIBLProbeCollection::SetFaceSize(int faceSize)
{
  constexpr int least = 32;
  constexpr int largest = 1024;
  int size = least;
  while (size < largest && 2 * size <= faceSize)
  {
    size *= 2;
  }
  if (size != this->FaceSize)
  {
    this->FaceSize = size;
    this->Modified();
  }
}
