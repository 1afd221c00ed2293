# Runs at installation: copies `headers` from the folder `from` into the folder `to` without
# subfolders and rewrites their includes to match.
file(REMOVE_RECURSE "${to}")
foreach(header IN LISTS headers)
  get_filename_component(name "${header}" NAME)
  if(EXISTS "${to}/${name}")
    message(FATAL_ERROR "Two headers are named ${name}")
  endif()
  file(READ "${from}/${header}" text)
  string(REGEX REPLACE "#include \"core/([a-z_0-9]+/)*([a-z_0-9]+\\.h)\"" "#include <holomorph/\\2>" text "${text}")
  file(WRITE "${to}/${name}" "${text}")
endforeach()
