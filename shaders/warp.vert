// Positions each vertex of the domain mesh: at a position that the CPU computed, or by applying a
// method's operator to its controls.
uniform mat3 to_clip;          // plane to clip coordinates
uniform vec2 rectangle_corner, rectangle_size;  // of the picture or the page, in plane units
uniform float margin;          // enlarges the page on all sides, in plane units
uniform int mode;              // 0: at rest, 1: positions, 2: operator
uniform int column_count;      // size of the operator
uniform int row_count;
uniform samplerBuffer operator_matrix;  // column by column, one complex number per vertex
uniform samplerBuffer operator_controls;

layout(location = 0) in vec2 rest;
layout(location = 1) in vec2 position;
layout(location = 2) in float value;

out vec2 uv;
out vec2 rest_position;     // rest position in plane units, for the checker
out float shade;
out vec2 warped;    // read back by transform feedback

// Meshes that are drawn by several programs cover the same pixels.
invariant gl_Position;

void main() {
  vec2 at = rest;
  vec2 place = (rest - rectangle_corner) / rectangle_size;
  if (margin > 0.0) at += margin * (2.0 * place - 1.0);
  if (mode == 1) at = position;
  if (mode == 2) {
    vec2 sum = vec2(0.0);
    for (int j = 0; j < column_count; ++j) {
      vec2 m = texelFetch(operator_matrix, j * row_count + gl_VertexID).xy;
      vec2 c = texelFetch(operator_controls, j).xy;
      sum += vec2(m.x * c.x - m.y * c.y, m.x * c.y + m.y * c.x);
    }
    at = rest + sum;
  }
  warped = at;
  uv = vec2(place.x, 1.0 - place.y);
  rest_position = mode == 0 ? at : rest;
  shade = value;
  gl_Position = vec4((to_clip * vec3(at, 1.0)).xy, 0.0, 1.0);
}
