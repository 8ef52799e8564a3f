// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lmdbench {

/// JSON Schema (draft 7) of meshes/manifest.json.
inline constexpr const char* MANIFEST_SCHEMA = R"json({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "type": "object",
  "additionalProperties": false,
  "required": ["format", "format_version", "sources", "meshes"],
  "properties": {
    "format": {"const": "lmdbench-mesh-manifest"},
    "format_version": {"const": 1},
    "sources": {
      "type": "object",
      "additionalProperties": {
        "type": "object",
        "additionalProperties": false,
        "required": ["package", "path", "sha256", "licence", "credit"],
        "properties": {
          "registry": {"enum": ["debian", "npm"]},
          "version": {"type": "string", "pattern": "^[0-9][0-9A-Za-z.+-]*$"},
          "package": {"type": "string", "pattern": "^[a-z0-9][a-z0-9+.-]+$"},
          "archive": {"type": "string", "pattern": "^[^/-]"},
          "path": {"type": "string", "pattern": "^[^/-]"},
          "sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$"},
          "licence": {"type": "string", "minLength": 1},
          "credit": {"type": "string", "minLength": 1}
        }
      }
    },
    "meshes": {
      "type": "object",
      "additionalProperties": {
        "type": "object",
        "additionalProperties": false,
        "required": ["description", "triangles"],
        "properties": {
          "description": {"type": "string", "minLength": 1},
          "source": {"type": "string"},
          "shape": {"type": "object", "required": ["kind"]},
          "target_triangles": {"type": "integer", "minimum": 4},
          "triangles": {"type": "integer", "minimum": 1},
          "optional": {"type": "boolean"},
          "sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$"}
        }
      }
    }
  }
})json";

}  // namespace lmdbench
