// Projects a surface in space to the camera.
uniform mat4 to_view;
uniform mat4 to_clip;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 coordinates;

out vec2 uv;
out vec3 seen;         // position in view space
out vec3 seen_normal;

void main() {
  vec4 at = to_view * vec4(position, 1.0);
  uv = coordinates;
  seen = at.xyz;
  seen_normal = mat3(to_view) * normal;
  gl_Position = to_clip * at;
}
