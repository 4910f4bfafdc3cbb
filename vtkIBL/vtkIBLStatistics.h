// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLStatistics
 * @brief what work was done for the light: how often, how long, over how many texels and bytes
 *
 * Work that was not needed was not done, and is not in here: that is how to see it. An environment counts what it does
 * for all who share it; a vtkIBLLighting counts its own stages and what its updates made the environment do.
 */
#ifndef vtkIBLStatistics_h
#define vtkIBLStatistics_h

#include "vtkIBLModule.h" // For export macro
#include "vtkObject.h"

#include <array>  // For std::array
#include <vector> // For std::vector

class VTKIBL_EXPORT vtkIBLStatistics : public vtkObject
{
public:
  static vtkIBLStatistics* New();
  vtkTypeMacro(vtkIBLStatistics, vtkObject);
  /**
   * A table, one line for each kind of work that was done.
   */
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Kinds
  {
    Read,                   ///< a file, an input or the studio, taken in and cleaned
    CacheHit,               ///< light found in vtkIBLCache; the time is that of hashing the file, too
    CacheWrite,             ///< light put there; beside the frames, so it has no time
    Harmonics,              ///< the source analysed
    CubeFaces,              ///< a lat-long source turned into six faces
    CubeMap,                ///< these on the GPU, with mip levels where they are read
    Layers,                 ///< of the specular chain; counted one by one
    IrradianceMap,          ///< made in one go with layers, its time is theirs
    IrradianceCoefficients, ///< vtkIBLIrradiance
    BRDFTable,
    ProbeFaces,  ///< of the scene, captured by vtkIBLProbe; the time of these two is that of the calls, the GPU may be
                 ///< behind
    ProbeLayers, ///< of probes' light
    Total        ///< all of these
  };
  static const char* GetKindName(int kind);

  ///@{
  /**
   * Since the start, or the last Reset(): how often, wall time [s] with the GPU finished, and texels and bytes that
   * were read (Read, Harmonics) or made (the rest). 0 when `kind` is none of Kinds.
   */
  vtkTypeInt64 GetCount(int kind) const { return this->GetWork(kind).Count; }
  double GetSeconds(int kind) const { return this->GetWork(kind).Seconds; }
  vtkTypeInt64 GetTexels(int kind) const { return this->GetWork(kind).Texels; }
  vtkTypeInt64 GetBytes(int kind) const { return this->GetWork(kind).Bytes; }
  ///@}

  /**
   * Begins at 0 again.
   */
  void Reset();

#ifndef __VTK_WRAP__
  struct Work
  {
    Kinds Kind = Total;
    vtkTypeInt64 Count = 0;
    vtkTypeInt64 Texels = 0;
    vtkTypeInt64 Bytes = 0;
    double Seconds = 0.0;
  };
  using Works = std::array<Work, Total>; // by kind
  ///@{
  /**
   * For vtkIBL's own classes, on the main thread: counts `work`; or what came to `now` since it was `before`.
   */
  void Add(const Work& work);
  void AddDifference(const Works& now, const Works& before);
  const Works& GetWorks() const
  {
    return this->Done;
  }
  ///@}
#endif

protected:
  vtkIBLStatistics();
  ~vtkIBLStatistics() override = default;

private:
  vtkIBLStatistics(const vtkIBLStatistics&) = delete;
  void operator=(const vtkIBLStatistics&) = delete;

  Work GetWork(int kind) const;

  Works Done;
};

#endif
