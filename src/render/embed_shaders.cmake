# Writes the header OUT, which contains each shader in FOLDER as a string.
set(text "// Generated from the folder shaders by the build.\n#pragma once\n\n")
foreach(pair IN ITEMS "warp.vert=kWarpVert" "image.frag=kImageFrag" "surface.vert=kSurfaceVert"
        "surface.frag=kSurfaceFrag" "composite.vert=kCompositeVert" "composite.frag=kCompositeFrag")
  string(REPLACE "=" ";" pair ${pair})
  list(GET pair 0 file)
  list(GET pair 1 name)
  file(READ ${FOLDER}/${file} source)
  string(APPEND text "inline constexpr const char* ${name} = R\"glsl(${source})glsl\";\n")
endforeach()
file(WRITE ${OUT} "${text}")
