// Exports of the open document: pictures and films, the cage, a textured surface, and copying.
#pragma once

#include "app/dialogs/export_dialog.h"

namespace holomorph {

/// The path of a file in the document's folder. If the document has no file yet, in the folder of
/// the last dialog or else of the document's first picture.
Path in_document_folder(const Document& document, const FileChooser& chooser,
                        const std::string& name);

class Exports {
 public:
  Exports(Workspace& workspace, Jobs& jobs, FileChooser& chooser, const std::function<void()>& wake)
      : workspace_(workspace),
        jobs_(jobs),
        chooser_(chooser),
        dialog_(workspace, jobs, chooser, wake) {}

  /// Handles an action's request if it is an export.
  void answer(Request request);
  /// Forgets the last export. Call this when another document is opened.
  void forget() { dialog_.forget(); }
  bool has_exported() const { return dialog_.has_exported(); }
  /// Whether the dialog for pictures and films is open.
  bool asking() const { return dialog_.open(); }
  void draw() { dialog_.draw(); }

 private:
  Path in_folder(const std::string& name) const;
  void copy_picture();
  void ask_cage();
  void ask_surface();
  /// Returns an error message, or "".
  std::string surface(const Path& path, double scale);

  Workspace& workspace_;
  Jobs& jobs_;
  FileChooser& chooser_;
  ExportDialog dialog_;
};

}  // namespace holomorph
