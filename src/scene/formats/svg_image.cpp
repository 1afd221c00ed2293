// Draws SVG files with the program rsvg-convert, which reads no other files, because it gets the
// drawing through a pipe.
#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/gzip.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/svg_document.h"
#include "system/process.h"
#include "system/text.h"

namespace holomorph {
namespace {

struct Text final : pugi::xml_writer {
  std::string text;
  void write(const void* data, size_t size) override {
    text.append(static_cast<const char*>(data), size);
  }
};

}  // namespace

namespace {

bool is_svg_text(std::string_view bytes) {
  constexpr size_t kFarthest = 1 << 16;  // behind comments and entities
  const size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string::npos || bytes[first] != '<') return false;
  const std::string_view start = bytes.substr(first, kFarthest);
  return start.find("<svg") != std::string_view::npos ||
         start.find(":svg") != std::string_view::npos;
}

}  // namespace

bool is_svg(const std::string& bytes) {
  constexpr size_t kStart = 1 << 16;
  if (is_gzip(bytes)) return is_svg_text(utf8_of_file(start_of_gzip(bytes, kStart)));
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    return is_svg_text(utf8_of_file(bytes.substr(0, kStart)));
  return is_svg_text(bytes);
}

Image decode_svg(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                 DrawingSize size) {
  SvgDocument document = svg_document_of(bytes, name, size);
  const auto columns = static_cast<size_t>(document.columns),
             rows = static_cast<size_t>(document.rows);
  pixels.take(columns, rows, name);
  pugi::xml_node root = document.root();
  if (!root.attribute("xmlns") && std::string(root.name()) == "svg")
    root.append_attribute("xmlns").set_value("http://www.w3.org/2000/svg");
  Text text;
  document.xml.save(text, "", pugi::format_raw);
  if (!has_program("rsvg-convert"))
    throw Error(ErrorKind::failed,
                name +
                    ": drawings need the program rsvg-convert, which is not installed; install "
                    "the package librsvg2-bin");
  const auto drawn = run_program({"rsvg-convert", "--format", "png", "--unlimited"}, text.text,
                                 {.limits = reader_limits()});
  if (drawn && drawn->out_of_time)
    throw Error(ErrorKind::bad_input, name + ": drawing this file takes too long; the limit is " +
                                          limit_text(&Budget::reader_seconds));
  if (!drawn || drawn->status != 0 || !is_png(drawn->output))
    throw Error(ErrorKind::bad_input,
                name +
                    ": rsvg-convert cannot draw this SVG file. If it needs much memory, the "
                    "limit is " +
                    limit_text(&Budget::reader_memory));
  PixelBudget again;
  Image image = decode_png(drawn->output, name, again, PixelDepth::eight_bits);
  if (image.width != document.columns || image.height != document.rows)
    throw Error(ErrorKind::failed, name + ": rsvg-convert drew this file in another size");
  return image;
}

}  // namespace holomorph
