// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLStage
 * @brief one stage of the pipeline on the GPU: builds when its input or a setting changed, and only then
 *
 * A stage reads only the stage to its left; staleness flows to the right only. A build that fails reports an error once
 * and leaves the last good output in place.
 */
#ifndef vtkIBLStage_h
#define vtkIBLStage_h

#include "vtkIBLModule.h"     // For export macro
#include "vtkIBLStatistics.h" // For what was done
#include "vtkObject.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <vector> // For std::vector

class vtkOpenGLRenderWindow;
class vtkWindow;

class VTKIBL_EXPORT vtkIBLStage : public vtkObject
{
public:
  vtkTypeMacro(vtkIBLStage, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Brings the output up to date in `window`'s context, with everything left of it, and returns whether there is an
   * output: true also when a build failed but an older output stands. Free when nothing changed. Output made in another
   * window is dropped first.
   */
  bool Update(vtkOpenGLRenderWindow* window);

  /**
   * Drops all GL objects. The next Update() builds again.
   */
  virtual void ReleaseGraphicsResources(vtkWindow* window);

  ///@{
  /**
   * What this stage did so far: builds, seconds of wall time of the last one (with the GPU finished), and texels that
   * it wrote.
   */
  vtkGetMacro(NumberOfBuilds, int);
  vtkGetMacro(LastBuildSeconds, double);
  vtkGetMacro(LastBuildTexels, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Where all builds are counted. Default: an object of its own; vtkIBLLighting's stages share one. Never null.
   */
  void SetStatistics(vtkIBLStatistics* statistics);
  vtkIBLStatistics* GetStatistics() const;
  ///@}

  /**
   * When the output was last built; 0 when there is none.
   */
  vtkMTimeType GetBuildTime() const;

protected:
  vtkIBLStage();
  ~vtkIBLStage() override;

  /// Brings what is left of this stage up to date; false: there is nothing to build from. `inputTime`: when it last
  /// changed.
  virtual bool UpdateInput(vtkOpenGLRenderWindow* window, vtkMTimeType& inputTime) = 0;
  /// Of what is left of this stage: time that it counts itself, while this stage builds, is its own. Null: none.
  virtual vtkIBLStatistics* GetInputStatistics() const { return nullptr; }
#ifndef __VTK_WRAP__
  /// Makes the output; returns what was done for it, without the time. Throws std::runtime_error and leaves the old
  /// output when it can't.
  virtual std::vector<vtkIBLStatistics::Work> Build(vtkOpenGLRenderWindow* window) = 0;
#endif
  /// Drops the output and all other GL objects.
  virtual void Release() = 0;

private:
  vtkIBLStage(const vtkIBLStage&) = delete;
  void operator=(const vtkIBLStage&) = delete;

  vtkSmartPointer<vtkIBLStatistics> Statistics;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  vtkMTimeType ContextTime = 0;
  vtkTimeStamp BuildTime;
  vtkTimeStamp AttemptTime;
  int NumberOfBuilds = 0;
  double LastBuildSeconds = 0.0;
  vtkTypeInt64 LastBuildTexels = 0;
};

#endif
