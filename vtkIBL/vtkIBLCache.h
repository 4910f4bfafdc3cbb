// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkIBLCache
 * @brief keeps baked light, so that a source is read and decoded once: in memory for this process, on disk for the next
 *
 * One per process, in use from the start; nothing need be called. A source is known by its content, never by its name
 * or date: a file that changes is baked anew, a copy of one is not.
 *
 * Each light is one OpenEXR file of at most some tens of megabytes, vtkIBL-KEY.exr, in Directory. Any number of
 * processes may share a directory, and what is in it may be deleted at any time. A file that is damaged, or not what
 * its name says, is reported once and replaced. What cannot be written is reported once and kept in memory only; no
 * picture depends on it.
 *
 * All methods may be called from any thread.
 */
#ifndef vtkIBLCache_h
#define vtkIBLCache_h

#include "vtkIBLModule.h" // For export macro
#include "vtkObject.h"

#include <memory> // For std::shared_ptr
#include <string> // For std::string

struct vtkIBLStoredLight;

class VTKIBL_EXPORT vtkIBLCache : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkIBLCache, vtkObject);

  ///@{
  /**
   * Off: nothing is found, nothing is kept; each light is baked from its source. Default on. The environment variable
   * VTKIBL_CACHE=off turns off what is on disk alone.
   */
  static void SetEnabled(bool enabled);
  static bool GetEnabled();
  ///@}

  ///@{
  /**
   * Where files go; made when the first is written. Default, and after null: vtkIBL below $XDG_CACHE_HOME or, without
   * that, below $HOME/.cache. Empty: memory only.
   */
  static void SetDirectory(const char* directory);
  static std::string GetDirectory();
  ///@}

  ///@{
  /**
   * How many bytes the files in Directory may have in all; whenever one is written, those that were not used for the
   * longest time go. Default 1 GiB, some hundred lights. Too small: the next start bakes again. Negative: a warning,
   * and the old value stays.
   */
  static void SetMaximumDiskBytes(vtkTypeInt64 bytes);
  static vtkTypeInt64 GetMaximumDiskBytes();
  ///@}

  ///@{
  /**
   * The same for what is held in memory, at once. Default 256 MiB. Too small: light comes from disk each time it is
   * asked for, some milliseconds. Lights in use are held by who uses them, whatever this says.
   */
  static void SetMaximumMemoryBytes(vtkTypeInt64 bytes);
  static vtkTypeInt64 GetMaximumMemoryBytes();
  ///@}

  /**
   * Forgets what is held in memory.
   */
  static void ClearMemory();

  ///@{
  /**
   * Since the process started: lights found in memory, found on disk, and not found. Among the last, files that were
   * there and could not be used. And bytes that are held now.
   */
  static vtkTypeInt64 GetNumberOfMemoryHits();
  static vtkTypeInt64 GetNumberOfDiskHits();
  static vtkTypeInt64 GetNumberOfMisses();
  static vtkTypeInt64 GetNumberOfBrokenFiles();
  static vtkTypeInt64 GetMemoryBytes();
  static vtkTypeInt64 GetDiskBytes();
  ///@}

#ifndef __VTK_WRAP__
  ///@{
  /**
   * For vtkIBL's own classes. The key of the light of a source, 32 hexadecimal digits: a hash of the source's bytes and
   * of `settings`, which names all else that the light depends on (for pixels, type and dimensions too). Empty when the
   * file cannot be read.
   */
  static std::string MakeFileKey(const std::string& fileName, const std::string& settings);
  static std::string MakePixelKey(const void* pixels, std::size_t bytes, const std::string& settings);
  ///@}

  /**
   * For vtkIBL's own classes. The light that was stored last under a key, or null.
   */
  static std::shared_ptr<const vtkIBLStoredLight> Find(const std::string& key);

  /**
   * For vtkIBL's own classes. Keeps a light that is whole, in place of what was there: who adds a part copies those
   * that Find() gave. One without parts is held in memory only. An empty key keeps nothing.
   */
  static void Store(const std::string& key, std::shared_ptr<const vtkIBLStoredLight> light);
#endif

protected:
  vtkIBLCache() = default;
  ~vtkIBLCache() override = default;

private:
  vtkIBLCache(const vtkIBLCache&) = delete;
  void operator=(const vtkIBLCache&) = delete;
};

#endif
