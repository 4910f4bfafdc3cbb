// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLProbeCollection
 * @brief the probes of a scene
 *
 * Any number; those in use at a time, up to 64, have light on the GPU, and an actor is lit by the four that reach
 * furthest into it. A mesh that spans more is best split.
 */
#ifndef vtkIBLProbeCollection_h
#define vtkIBLProbeCollection_h

#include "vtkCollection.h"
#include "vtkIBLModule.h" // For export macro

class vtkIBLProbe;

class VTKIBL_EXPORT vtkIBLProbeCollection : public vtkCollection
{
public:
  static vtkIBLProbeCollection* New();
  vtkTypeMacro(vtkIBLProbeCollection, vtkCollection);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Adds a probe, or gives the next one of a traversal; null after the last.
   */
  void AddItem(vtkIBLProbe* probe);
  vtkIBLProbe* GetNextProbe(vtkCollectionSimpleIterator& cookie);
  vtkIBLProbe* GetProbe(int index);
  ///@}

  ///@{
  /**
   * Texels along an edge of the six faces that all probes have, rounded down to a power of two in [32, 1024]. Default
   * 128: a mirror shows texels of 0.7 degrees. A probe takes 2.5 MiB at 128, four times that at twice the size.
   */
  void SetFaceSize(int faceSize);
  vtkGetMacro(FaceSize, int);
  ///@}

  ///@{
  /**
   * Samples a texel of the layers that sharp reflections are read from, in [16, 65536]. Default 32: see
   * vtkIBLSpecularChain::SetNumberOfSamples().
   */
  vtkSetClampMacro(NumberOfSamples, int, 16, 65536);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

protected:
  vtkIBLProbeCollection() = default;
  ~vtkIBLProbeCollection() override = default;

private:
  vtkIBLProbeCollection(const vtkIBLProbeCollection&) = delete;
  void operator=(const vtkIBLProbeCollection&) = delete;
  void AddItem(vtkObject*) = delete; // only probes

  int FaceSize = 128;
  int NumberOfSamples = 32;
};

#endif
