// Picture files as other programs write them.
#pragma once

#include <gif_lib.h>
#include <tiffio.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cstdio>  // before jpeglib.h
// jpeglib.h must come before png.h.
#include <jpeglib.h>
#include <png.h>

#include <cstring>
#include <string>

#include "scene/formats/image.h"

namespace holomorph {

struct PngKind {
  std::string exif = {}, profile = {};
  double gamma = 0;  ///< 0: none
  bool srgb = false, adobe = false, interlaced = false, sixteen = false;
  int gray_bits = 0;  ///< 0: color; otherwise gray, from the red channel
};

inline std::string png_file(const Image& image, const PngKind& kind) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, size_t size) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), size);
      },
      nullptr);
  const int depth = kind.gray_bits ? kind.gray_bits : kind.sixteen ? 16 : 8;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), depth,
               kind.gray_bits ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB_ALPHA,
               kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (kind.gamma > 0) png_set_gAMA(png, info, kind.gamma);
  if (kind.adobe) png_set_cHRM(png, info, 0.3127, 0.3290, 0.64, 0.33, 0.21, 0.71, 0.15, 0.06);
  if (kind.srgb) {
    png_unknown_chunk chunk{};
    std::memcpy(chunk.name, "sRGB", 5);
    png_byte intent = 0;
    chunk.data = &intent;
    chunk.size = 1;
    chunk.location = PNG_HAVE_IHDR;
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, chunk.name, 1);
    png_set_unknown_chunks(png, info, &chunk, 1);
  }
  if (!kind.profile.empty())
    png_set_iCCP(png, info, "profile", PNG_COMPRESSION_TYPE_BASE,
                 reinterpret_cast<png_const_bytep>(kind.profile.data()),
                 static_cast<png_uint_32>(kind.profile.size()));
  std::string exif = kind.exif;
  if (!exif.empty())
    png_set_eXIf_1(png, info, static_cast<png_uint_32>(exif.size()),
                   reinterpret_cast<png_bytep>(exif.data()));
  png_write_info(png, info);
  std::vector<std::string> rows;
  for (int r = 0; r < image.height; ++r) {
    std::string row;
    if (kind.gray_bits) {
      unsigned bits = 0;
      for (int c = 0; c < image.width; ++c) {
        bits = bits << kind.gray_bits | (image.at(c, r)[0] >> (8 - kind.gray_bits));
        if ((c + 1) * kind.gray_bits % 8 == 0 || c + 1 == image.width) {
          const int missing = (8 - (c + 1) * kind.gray_bits % 8) % 8;
          row += static_cast<char>(bits << missing);
        }
      }
    } else {
      for (int i = 0; i < 4 * image.width; ++i)
        row += std::string(kind.sixteen ? 2 : 1, static_cast<char>(image.at(0, r)[i]));
    }
    rows.push_back(row);
  }
  std::vector<png_bytep> pointers;
  for (std::string& row : rows) pointers.push_back(reinterpret_cast<png_bytep>(row.data()));
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

enum class JpegKind { color, gray, inks, adobe_inks };
struct JpegOptions {
  std::string exif = {}, profile = {};
  JpegKind kind = JpegKind::color;
  bool progressive = false;
  bool many_scans = false;  ///< 200 scans
};

inline std::string jpeg_file(const Image& image, const JpegOptions& options) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &out, &size);
  jpeg.image_width = static_cast<JDIMENSION>(image.width);
  jpeg.image_height = static_cast<JDIMENSION>(image.height);
  const bool inks = options.kind == JpegKind::inks || options.kind == JpegKind::adobe_inks;
  jpeg.input_components = options.kind == JpegKind::gray ? 1 : inks ? 4 : 3;
  jpeg.in_color_space = options.kind == JpegKind::gray ? JCS_GRAYSCALE : inks ? JCS_CMYK : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg.write_Adobe_marker = options.kind == JpegKind::adobe_inks;
  jpeg_set_quality(&jpeg, 95, TRUE);
  for (int c = 0; c < jpeg.num_components; ++c)  // colors at full resolution
    jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
  if (options.progressive) jpeg_simple_progression(&jpeg);
  std::vector<jpeg_scan_info> scans;
  if (options.many_scans) {
    jpeg_scan_info first{};
    first.comps_in_scan = 3;
    for (int c = 0; c < 3; ++c) first.component_index[c] = c;
    first.Al = 10;
    scans.push_back(first);
    for (int c = 0; c < 3; ++c)
      for (int k = 1; k < 64; ++k) {
        jpeg_scan_info scan{};
        scan.comps_in_scan = 1;
        scan.component_index[0] = c;
        scan.Ss = scan.Se = k;
        scans.push_back(scan);
      }
    for (int a = 10; a > 0; --a) {
      first.Ah = a;
      first.Al = a - 1;
      scans.push_back(first);
    }
    jpeg.scan_info = scans.data();
    jpeg.num_scans = static_cast<int>(scans.size());
  }
  jpeg_start_compress(&jpeg, TRUE);
  if (!options.exif.empty()) {
    const std::string exif = "Exif" + std::string(2, '\0') + options.exif;
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(exif.data()),
                      static_cast<unsigned>(exif.size()));
  }
  if (!options.profile.empty())
    jpeg_write_icc_profile(&jpeg, reinterpret_cast<const JOCTET*>(options.profile.data()),
                           static_cast<unsigned>(options.profile.size()));
  for (int r = 0; r < image.height; ++r) {
    std::vector<JSAMPLE> row;
    for (int c = 0; c < image.width; ++c) {
      const std::uint8_t* p = image.at(c, r);
      if (options.kind == JpegKind::gray) {
        row.push_back(static_cast<JSAMPLE>((p[0] + p[1] + p[2]) / 3));
        continue;
      }
      for (int k = 0; k < 3; ++k)
        row.push_back(options.kind == JpegKind::inks ? static_cast<JSAMPLE>(255 - p[k]) : p[k]);
      if (inks) row.push_back(options.kind == JpegKind::inks ? 0 : 255);  // no black
    }
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string bytes(reinterpret_cast<char*>(out), size);
  jpeg_destroy_compress(&jpeg);
  std::free(out);
  return bytes;
}

struct WebpKind {
  std::string exif = {}, profile = {};
};

inline std::string webp_file(const Image& image, const WebpKind& kind) {
  std::uint8_t* data = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(image.pixels.data(), image.width, image.height,
                                             4 * image.width, &data);
  const WebPData plain{data, size};
  WebPMux* mux = WebPMuxCreate(&plain, 1);
  WebPFree(data);
  const auto add = [&](const char* name, const std::string& content) {
    const WebPData chunk{reinterpret_cast<const uint8_t*>(content.data()), content.size()};
    if (!content.empty()) WebPMuxSetChunk(mux, name, &chunk, 1);
  };
  add("EXIF", kind.exif);
  add("ICCP", kind.profile);
  WebPData whole{};
  WebPMuxAssemble(mux, &whole);
  std::string bytes(reinterpret_cast<const char*>(whole.bytes), whole.size);
  WebPDataClear(&whole);
  WebPMuxDelete(mux);
  return bytes;
}

struct TiffKind {
  int orientation = 1;
  std::string profile = {};
};

inline std::string tiff_file(const Image& image, const TiffKind& kind) {
  char name[] = "/tmp/holomorph-tiff-XXXXXX";
  ::close(::mkstemp(name));
  TIFF* file = TIFFOpen(name, "w");
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, image.width);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, image.height);
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 4);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 8);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  TIFFSetField(file, TIFFTAG_ORIENTATION, kind.orientation);
  TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  const std::uint16_t extra[] = {EXTRASAMPLE_UNASSALPHA};
  TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, extra);
  if (!kind.profile.empty())
    TIFFSetField(file, TIFFTAG_ICCPROFILE, static_cast<uint32_t>(kind.profile.size()),
                 kind.profile.data());
  for (int r = 0; r < image.height; ++r) {
    std::string row(reinterpret_cast<const char*>(image.at(0, r)),
                    4 * static_cast<size_t>(image.width));
    TIFFWriteScanline(file, row.data(), static_cast<uint32_t>(r), 0);
  }
  TIFFClose(file);
  const std::string bytes = read_file(name);
  std::remove(name);
  return bytes;
}

/// A GIF file with a palette of 256 colors.
inline std::string gif_file(const Image& image) {
  std::string bytes;
  int wrong = 0;
  GifFileType* file = EGifOpen(
      &bytes,
      [](GifFileType* f, const GifByteType* data, int size) {
        static_cast<std::string*>(f->UserData)
            ->append(reinterpret_cast<const char*>(data), static_cast<size_t>(size));
        return size;
      },
      &wrong);
  ColorMapObject* colors = GifMakeMapObject(256, nullptr);
  for (int i = 0; i < 256; ++i)
    colors->Colors[i] = {static_cast<GifByteType>(i & 0xe0),
                         static_cast<GifByteType>(i << 3 & 0xe0), static_cast<GifByteType>(i << 6)};
  EGifPutScreenDesc(file, image.width, image.height, 8, 0, colors);
  EGifPutImageDesc(file, 0, 0, image.width, image.height, false, nullptr);
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c) {
      const std::uint8_t* p = image.at(c, r);
      EGifPutPixel(file, static_cast<GifPixelType>((p[0] & 0xe0) | (p[1] >> 3 & 0x1c) | p[2] >> 6));
    }
  EGifCloseFile(file, &wrong);
  GifFreeMapObject(colors);
  return bytes;
}

inline std::string little(size_t value, size_t count) {
  std::string bytes;
  for (size_t k = 0; k < count; ++k) bytes += static_cast<char>(value >> 8 * k);
  return bytes;
}
inline std::string big(size_t value, size_t count) {
  const std::string bytes = little(value, count);
  return {bytes.rbegin(), bytes.rend()};
}

inline std::string bmp_file(const Image& image) {
  const size_t w = static_cast<size_t>(image.width), h = static_cast<size_t>(image.height);
  std::string bytes = "BM" + little(54 + 4 * w * h, 4) + little(0, 4) + little(54, 4) +
                      little(40, 4) + little(w, 4) + little(h, 4) + little(1, 2) + little(32, 2) +
                      std::string(24, '\0');
  for (int r = image.height - 1; r >= 0; --r)
    for (int c = 0; c < image.width; ++c)
      for (const int k : {2, 1, 0, 3}) bytes += static_cast<char>(image.at(c, r)[k]);
  return bytes;
}

inline std::string tga_file(const Image& image, bool packed) {
  const size_t w = static_cast<size_t>(image.width), h = static_cast<size_t>(image.height);
  std::string bytes = little(0, 2) + little(packed ? 10 : 2, 1) + std::string(9, '\0') +
                      little(w, 2) + little(h, 2) + little(32, 1) + little(0x28, 1);
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    if (packed && i % 256 == 0)
      bytes += static_cast<char>(std::min<size_t>(64, (image.pixels.size() - i) / 4) - 1);
    for (const size_t k : {2, 1, 0, 3}) bytes += static_cast<char>(image.pixels[i + k]);
  }
  return bytes;
}

inline std::string psd_file(const Image& image, bool packed) {
  const size_t w = static_cast<size_t>(image.width), h = static_cast<size_t>(image.height);
  std::string bytes = "8BPS" + big(1, 2) + std::string(6, '\0') + big(4, 2) + big(h, 4) +
                      big(w, 4) + big(8, 2) + big(3, 2) + std::string(12, '\0') + big(packed, 2);
  std::string lengths, rows;
  for (size_t k = 0; k < 4; ++k)
    for (int r = 0; r < image.height; ++r) {
      std::string row;
      for (int c = 0; c < image.width; ++c) {
        if (packed && c % 128 == 0) row += static_cast<char>(std::min(128, image.width - c) - 1);
        row += static_cast<char>(image.at(c, r)[k]);
      }
      lengths += big(row.size(), 2);
      rows += row;
    }
  return bytes + (packed ? lengths : "") + rows;
}

}  // namespace holomorph
