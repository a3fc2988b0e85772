//! Negative controls: a library with one fault put into it must fail, and exactly the faults below are put into it.

use std::collections::BTreeSet;
use std::path::Path;

use bossage_conformance::report::matrix::{Cell, Column, Matrix};
use bossage_conformance::route::Fault;
use bossage_conformance::suite::scene::files_in;
use bossage_conformance::{CaseResult, Route, Selection, Verdict};
use bossage_shaders::Library;

use crate::support::{listed, report, root};

/// One fault: in `file`, `from` becomes `to`; the cases of `filter` must notice.
struct Mutant {
    what: &'static str,
    file: &'static str,
    from: &'static str,
    to: &'static str,
    filter: &'static str,
}

const MUTANTS: &[Mutant] = &[
    Mutant {
        what: "light through the relief",
        file: "entry/surface_fragment.wesl",
        from: "color += seen * lights.items",
        to: "color += lights.items",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "the depth of the polygon in place of the relief's",
        file: "entry/surface_fragment.wesl",
        from: "pixel_depth(place, view.clip_z",
        to: "pixel_depth(interpolated.position, view.clip_z",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "the tangent frame transposed",
        file: "techniques/light_to_tangent.wesl",
        from: "return vec3f(dot(tangent, light), dot(bitangent_dir, light), dot(normal, light));",
        to: "return mat3x3f(tangent, bitangent_dir, normal) * light;",
        filter: "light_to_tangent",
    },
    Mutant {
        what: "T and B in the wrong order",
        file: "techniques/light_to_tangent.wesl",
        from: "return vec3f(dot(tangent, light), dot(bitangent_dir, light), dot(normal, light));",
        to: "return vec3f(dot(bitangent_dir, light), dot(tangent, light), dot(normal, light));",
        filter: "light_to_tangent",
    },
    Mutant {
        what: "the bitangent the wrong way round",
        file: "lib/frame.wesl",
        from: "cross(normal, tangent.xyz)",
        to: "cross(tangent.xyz, normal)",
        filter: "frame_mikktspace",
    },
    Mutant {
        what: "a normalise dropped",
        file: "lib/normalise.wesl",
        from: "return scaled / sqrt(dot(scaled, scaled));",
        to: "return scaled;",
        filter: "dot3/hardened",
    },
    Mutant {
        what: "components swapped",
        file: "techniques/height_to_normal.wesl",
        from: "return vec3f(-gx * r, -gy * r, r);",
        to: "return vec3f(-gy * r, -gx * r, r);",
        filter: "height_to_normal/random",
    },
    Mutant {
        what: "a constant off by one per cent",
        file: "techniques/parallax_offset.wesl",
        from: "const MIN_VIEW_Z: f32 = 0.05;",
        to: "const MIN_VIEW_Z: f32 = 0.0505;",
        filter: "parallax_offset/hardened",
    },
    Mutant {
        what: "an exponent off by one per cent",
        file: "techniques/blinn_phong.wesl",
        from: "return pow(base, max(shininess, 0.0));",
        to: "return pow(base, 1.01 * max(shininess, 0.0));",
        filter: "blinn_phong/hardened",
    },
    Mutant {
        what: "a clamp dropped",
        file: "lib/lambert.wesl",
        from: "return saturate(dot(normal, light_dir));",
        to: "return dot(normal, light_dir);",
        filter: "dot3/hardened",
    },
    Mutant {
        what: "a bias dropped",
        file: "lib/relief.wesl",
        from: "return height_scale * height + height_bias;",
        to: "return height_scale * height;",
        filter: "relief",
    },
    Mutant {
        what: "the mirror edge without its repeated texel",
        file: "lib/edge.wesl",
        from: "min(k, 2 * n - 1 - k)",
        to: "min(k, 2 * n - 2 - k)",
        filter: "edge/edge",
    },
    Mutant {
        what: "rounding replaced by truncation",
        file: "techniques/codec_biased.wesl",
        from: "* 127.0 + 128.5);",
        to: "* 127.0 + 128.0);",
        filter: "codec_biased/hardened",
    },
    Mutant {
        what: "a cone over a cell's highest point instead of its lowest",
        file: "entry/cone_map.wesl",
        from: "base.lowest = min(min(h.x, h.y), min(h.z, h.w));",
        to: "base.lowest = max(max(h.x, h.y), max(h.z, h.w));",
        filter: "relaxed_cone_map/bake:edge=clamp;field=block",
    },
    Mutant {
        what: "nodes two texels further away than they are",
        file: "entry/cone_map.wesl",
        from: "return rise / length(gap);",
        to: "return rise / (length(gap) + 2.0);",
        filter: "cone_map/bake:edge=clamp;field=spike",
    },
    Mutant {
        what: "the tiles beside a cone's own left out",
        file: "entry/cone_map.wesl",
        from: "let folds = select(3u, 1u, bake.edge_mode == 2u);",
        to: "let folds = 1u;",
        filter: "cone_map/bake:edge=wrap;field=spike",
    },
    Mutant {
        what: "falling flanks passed over as if they rose",
        file: "entry/cone_map.wesl",
        from: "return x + y >= 0.0;",
        to: "return true;",
        filter: "relaxed_cone_map/bake:edge=clamp;field=noise",
    },
    Mutant {
        what: "cones half as wide as they may be",
        file: "entry/cone_map.wesl",
        from: "= ratio * (1.0 - CONE_ROUNDED);",
        to: "= 0.5 * ratio;",
        filter: "cone_map/bake:edge=clamp;field=noise",
    },
    Mutant {
        what: "a corner of a texel's square left out of its maximum",
        file: "entry/max_mip.wesl",
        from: "quarter < 4u",
        to: "quarter < 3u",
        filter: "max_mip/bake",
    },
    Mutant {
        what: "a mean of four heights rounded down",
        file: "entry/max_mip.wesl",
        from: "+ across + 3u) / 4u",
        to: "+ across) / 4u",
        filter: "max_mip/bake",
    },
    Mutant {
        what: "the third node of an odd side left out",
        file: "entry/max_mip.wesl",
        from: "* bake.size + size - 1u) / size;",
        to: "* bake.size) / size;",
        filter: "max_mip/bake",
    },
    Mutant {
        what: "the last column of a bake not written",
        file: "entry/height_to_normal.wesl",
        from: "if (any(id.xy >= size)) {",
        to: "if (any(id.xy + vec2u(1u, 0u) >= size)) {",
        filter: "height_to_normal/bake",
    },
    Mutant {
        what: "a vertex' first triangle left out",
        file: "entry/frame_from_uv.wesl",
        from: "var entry = adjacency_offsets[vertex];",
        to: "var entry = adjacency_offsets[vertex] + 1u;",
        filter: "frame_from_uv/hardened/mesh",
    },
    Mutant {
        what: "a cube's rows the other way round",
        file: "entry/normalisation_cube_map_lookup.wesl",
        from: "let centre = (2.0 * at + 1.0 - size) / size;",
        to: "let centre = (2.0 * vec2f(at.x, size - 1.0 - at.y) + 1.0 - size) / size;",
        filter: "normalisation_cube_map/lookup:bits=08;filter=face;size=016",
    },
    Mutant {
        what: "a filter's weights a hundredth of a texel off",
        file: "entry/normalisation_cube_map_lookup.wesl",
        from: "colours[id.x] = mix(near, far, at.fraction.y);",
        to: "colours[id.x] = mix(near, far, at.fraction.y + 0.01);",
        filter: "normalisation_cube_map/lookup:bits=08;filter=face;size=016",
    },
    Mutant {
        what: "a sampler asked for the opposite direction",
        file: "entry/normalisation_cube_map_lookup.wesl",
        from: "surface_sampler, directions[id.x].xyz, 0.0);",
        to: "surface_sampler, -directions[id.x].xyz, 0.0);",
        filter: "normalisation_cube_map/lookup:bits=16;filter=sampler;size=064",
    },
    Mutant {
        what: "tangents along the other texture axis",
        file: "techniques/frame_from_uv.wesl",
        from: "let tangent = (p * st2.y - q * st1.y) * side;",
        to: "let tangent = (p * st2.x - q * st1.x) * side;",
        filter: "frame_mikktspace/mesh",
    },
    Mutant {
        what: "vertices displaced inward",
        file: "techniques/displacement.wesl",
        from: "return position + elevation(",
        to: "return position - elevation(",
        filter: "displacement/grid",
    },
    Mutant {
        what: "the elevation of a silhouette off by ten per cent",
        file: "techniques/displacement.wesl",
        from: "return position + elevation(",
        to: "return position + 1.1 * elevation(",
        filter: "displacement/silhouette",
    },
    Mutant {
        what: "the normal of a displaced vertex left as it was",
        file: "entry/surface_vertex.wesl",
        from: "out.normal = lighting_space_normal(displaced_normal(vertex.normal, vertex.tangent, vertex.uv));",
        to: "out.normal = lighting_space_normal(vertex.normal);",
        filter: "displacement/grid",
    },
    Mutant {
        what: "the first of two passes off by one per cent",
        file: "entry/surface_fragment.wesl",
        from: "dot3_first_pass(normal_color, light_color) * light.radiance.rgb",
        to: "1.01 * dot3_first_pass(normal_color, light_color) * light.radiance.rgb",
        filter: "dot3_two_pass/passes",
    },
    Mutant {
        what: "the second pass' colour squared",
        file: "entry/surface_fragment.wesl",
        from: "    @else\n    out.color = albedo;",
        to: "    @else\n    out.color = albedo * albedo;",
        filter: "dot3_two_pass/passes",
    },
    Mutant {
        what: "a published defect cured",
        file: "techniques/parallax_offset.wesl",
        from: "return uv + z * view_dir_ts.xy / view_dir_ts.z;",
        to: "return uv + z * view_dir_ts.xy / max(view_dir_ts.z, MIN_VIEW_Z);",
        filter: "parallax_offset/published/defect",
    },
    Mutant {
        what: "the surface's ambient light off by one per cent",
        file: "entry/surface_fragment.wesl",
        from: "var color = material.ambient.rgb * albedo.rgb;",
        to: "var color = 1.01 * material.ambient.rgb * albedo.rgb;",
        filter: "scene/planned:scene=brick_wall",
    },
    Mutant {
        what: "the surface's normal map not decoded",
        file: "entry/surface_fragment.wesl",
        from: "normal_texel * material.normal_decode.x + material.normal_decode.y;",
        to: "normal_texel * material.normal_decode.x;",
        filter: "scene/planned:scene=brick_wall",
    },
    Mutant {
        what: "the surface's relief turned round",
        file: "entry/surface_fragment.wesl",
        from: "let z = elevation(height,",
        to: "let z = -elevation(height,",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "the surface's exact walk towards the eye",
        file: "entry/surface_fragment.wesl",
        from: "let hit = exact(height_map, relief_map, surface_sampler, read, ray);",
        to: "var back = ray;\n    @if(exact && !given_hit)\n    back.delta = -ray.delta;\n    @if(exact && !given_hit)\n    let hit = exact(height_map, relief_map, surface_sampler, read, back);",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "the surface's search through a layer that is turned over along v",
        file: "entry/surface_fragment.wesl",
        from: "let ray = relief_ray(interpolated.uv, view_dir_ts, material.relief.xyz);",
        to: "let ray = relief_ray(interpolated.uv, view_dir_ts, material.relief.xyz * vec3f(1.0, 1.0, -1.0));",
        filter: "scene/planned:scene=brick_wall",
    },
    Mutant {
        what: "a highlight dropped that the scene calls for",
        file: "entry/surface_fragment.wesl",
        from: "    color += light.radiance.rgb\n        * blinn_phong(normal, light_dir, view_dir, albedo.rgb, material.specular.rgb, material.shininess);",
        to: "    color += light.radiance.rgb * (saturate(dot(normal, light_dir)) * albedo.rgb);",
        filter: "scene/agreement:scene=brick_wall",
    },
    Mutant {
        what: "a normal map dropped that the scene calls for",
        file: "entry/surface_fragment.wesl",
        from: "    @elif(unit_normal && normal_map)\n    let normal = normalise(combine_frame(",
        to: "    @elif(unit_normal && normal_map && !many_lights)\n    let normal = normalise(interpolated.normal);\n    @elif(unit_normal && normal_map)\n    let normal = normalise(combine_frame(",
        filter: "scene/agreement:scene=brick_wall",
    },
    Mutant {
        what: "a highlight of many lights dropped",
        file: "entry/surface_fragment.wesl",
        from: "        @if(specular && !shadow)\n        color += lights.items[index].radiance.rgb\n            * blinn_phong(normal, light_dir, view_dir, albedo.rgb, material.specular.rgb, material.shininess);",
        to: "        @if(specular && !shadow)\n        color += lights.items[index].radiance.rgb * (saturate(dot(normal, light_dir)) * albedo.rgb);",
        filter: "scene/planned:scene=gallery",
    },
    Mutant {
        what: "red and green of a highlight swapped",
        file: "entry/surface_fragment.wesl",
        from: "            * blinn_phong(normal, light_dir, view_dir, albedo.rgb, material.specular.rgb, material.shininess);",
        to: "            * blinn_phong(normal, light_dir, view_dir, albedo.rgb, material.specular.grb, material.shininess);",
        filter: "scene/planned:scene=gallery",
    },
    Mutant {
        what: "a single point light moved",
        file: "entry/surface_fragment.wesl",
        from: "let light_dir = normalise(light.vector.xyz - interpolated.position);",
        to: "let light_dir = normalise(light.vector.xyz + vec3f(0.0, 0.1, 0.0) - interpolated.position);",
        filter: "scene/planned:scene=bump_and_parallax",
    },
    Mutant {
        what: "the ambient light of a slope relief not occluded",
        file: "entry/surface_fragment.wesl",
        from: "wrap_lambert_factor(ambient_occlusion, material.ambient.r, bent_normal, light_dir);",
        to: "wrap_lambert_factor(1.0, material.ambient.r, bent_normal, light_dir);",
        filter: "scene/planned:scene=parallax_occlusion",
    },
    Mutant {
        what: "a second height read from the wrong side",
        file: "entry/surface_fragment.wesl",
        from: "emboss_uv(uv, light_dir_ts, material.emboss_step)",
        to: "emboss_uv(uv, light_dir_ts, -material.emboss_step)",
        filter: "scene/planned:scene=emboss",
    },
    Mutant {
        what: "a mirror turned over",
        file: "entry/surface_fragment.wesl",
        from: "surface_sampler, reflected_dir, 0.0)",
        to: "surface_sampler, -reflected_dir, 0.0)",
        filter: "scene/planned:scene=environment_bump",
    },
    Mutant {
        what: "a normalisation cube map read the other way round",
        file: "entry/surface_fragment.wesl",
        from: "surface_sampler, light_ts, 0.0).rgb;",
        to: "surface_sampler, -light_ts, 0.0).rgb;",
        filter: "scene/planned:scene=dot3_cube",
    },
    Mutant {
        what: "the first of two passes without its normal map",
        file: "entry/surface_fragment.wesl",
        from: "dot3_first_pass(normal_color, light_color)",
        to: "dot3_first_pass(vec3f(0.5, 0.5, 1.0), light_color)",
        filter: "scene/planned:scene=dot3_cube_two_pass",
    },
    Mutant {
        what: "red and green of one light's highlight swapped",
        file: "entry/surface_fragment.wesl",
        from: "        * blinn_phong(normal, light_dir, view_dir, albedo.rgb, material.specular.rgb, material.shininess);\n    @elif",
        to: "        * blinn_phong(normal, light_dir, view_dir, albedo.rgb, material.specular.grb, material.shininess);\n    @elif",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "a point light moved by a hundredth",
        file: "entry/surface_fragment.wesl",
        from: "let light_dir = normalise(light.vector.xyz - interpolated.position);",
        to: "let light_dir = normalise(light.vector.xyz + vec3f(0.01, 0.0, 0.0) - interpolated.position);",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "a highlight a tenth of a per cent too bright",
        file: "techniques/blinn_phong.wesl",
        from: "return lambert(normal, light_dir) * diffuse + highlight * specular;",
        to: "return lambert(normal, light_dir) * diffuse + 1.001 * highlight * specular;",
        filter: "surface/hardened/permutations:shading=blinn_phong",
    },
    Mutant {
        what: "an alpha that is the cutoff cut out",
        file: "entry/surface_fragment.wesl",
        from: "if (albedo.a < material.alpha_cutoff) {",
        to: "if (albedo.a <= material.alpha_cutoff) {",
        filter: "surface/cutoff:shading=blinn_phong",
    },
    Mutant {
        what: "an alpha below the cutoff kept",
        file: "entry/surface_fragment.wesl",
        from: "if (albedo.a < material.alpha_cutoff) {",
        to: "if (albedo.a < material.alpha_cutoff - 0.0000001) {",
        filter: "surface/cutoff:shading=blinn_phong",
    },
    Mutant {
        what: "a mirrored object's handedness left as it was",
        file: "entry/surface_vertex.wesl",
        from: "return handedness * object.handedness_sign.x;",
        to: "return handedness;",
        filter: "surface/vertices",
    },
    Mutant {
        what: "the slopes of displaced vertices off by one per cent",
        file: "entry/surface_vertex.wesl",
        from: "object.displacement.x * 0.5 * side,",
        to: "object.displacement.x * 0.505 * side,",
        filter: "surface/vertices",
    },
    Mutant {
        what: "vertices in the wrong place of the picture by a thousandth",
        file: "entry/surface_vertex.wesl",
        from: "out.clip_position = object.clip_from_local * vec4f(position, 1.0);",
        to: "out.clip_position = object.clip_from_local * vec4f(position * 1.001, 1.0);",
        filter: "surface/vertices",
    },
];

fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(to)?;
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(&entry.path(), &target)?
        } else {
            std::fs::copy(entry.path(), target).map(drop)?
        }
    }
    Ok(())
}

fn selection(filter: &str) -> Selection {
    Selection {
        filter: Some(filter.to_owned()),
        routes: vec![Route::Wgsl],
        scenes: files_in(&root().join("examples")).expect("the examples are there"),
        ..Selection::default()
    }
}

/// The library with the fault in it.
fn broken(mutant: &Mutant) -> Library {
    let folder = tempfile::tempdir().expect("a temporary folder");
    copy(&root().join("shaders"), folder.path()).expect("the shaders can be copied");
    let file = folder.path().join(mutant.file);
    let text = std::fs::read_to_string(&file).expect("the mutant's file is there");
    assert!(
        text.contains(mutant.from),
        "{}: `{}` is not in {}",
        mutant.what,
        mutant.from,
        mutant.file
    );
    std::fs::write(&file, text.replace(mutant.from, mutant.to)).expect("the copy can be written");
    Library::from_dir(folder.path()).expect("the mutant is a whole library")
}

#[test]
fn every_fault_is_caught() {
    let mut missed = Vec::new();
    for mutant in MUTANTS {
        let library = broken(mutant);
        let Some(report) = report(mutant.what, &selection(mutant.filter), &library) else {
            return;
        };
        if report.failures().next().is_none() {
            missed.push(mutant.what);
        }
    }
    assert!(missed.is_empty(), "not caught: {missed:?}");
}

/// Textures of bytes, filtered by a driver, hide what no driver's filter stands before.
#[test]
fn an_ideal_filter_shows_a_fault_of_a_hundredth_of_a_per_cent() {
    let mutant = Mutant {
        what: "the surface's normal map decoded a hundredth of a per cent too long",
        file: "entry/surface_fragment.wesl",
        from: "normal_texel * material.normal_decode.x + material.normal_decode.y;",
        to: "normal_texel * (1.0001 * material.normal_decode.x) + material.normal_decode.y;",
        filter: "scene/planned:scene=brick_wall",
    };
    let library = broken(&mutant);
    let fails = |route| {
        let selection = Selection {
            routes: vec![route],
            ..selection(mutant.filter)
        };
        let report = report(mutant.what, &selection, &library)?;
        Some(report.failures().next().is_some())
    };
    assert_eq!(fails(Route::Embedded), Some(true));
    assert_ne!(fails(Route::Wgsl), Some(true), "a driver's filter hides it");
}

#[test]
fn the_same_cases_pass_without_a_fault() {
    let library = Library::from_dir(&root().join("shaders")).expect("the library is whole");
    for mutant in MUTANTS {
        let Some(report) = report(mutant.what, &selection(mutant.filter), &library) else {
            return;
        };
        let failed: Vec<String> = report
            .failures()
            .map(|case| format!("{}: {:?}", case.id, case.reason))
            .collect();
        assert!(failed.is_empty(), "{}: {failed:?}", mutant.what);
    }
}

/// Each route with a fault in what it emits and nowhere else: the least view angle off by a per cent, by the name that the language gives
/// to the number, or two components swapped.
const PLANTED: [(Route, &str, &str); 8] = [
    (Route::Wgsl, "0.05", "0.0505"),
    (Route::Spirv, "0.05", "0.0505"),
    (Route::Hlsl, "0.05", "0.0505"),
    (Route::Glsl, "0.05", "0.0505"),
    (Route::Opengl, "0.05", "0.0505"),
    (Route::Tint, "0.05f", "0.0505f"),
    (Route::Msl, "view_dir_ts.xy", "view_dir_ts.yx"),
    (Route::Embedded, "0.05", "0.0505"),
];

#[test]
fn a_fault_in_one_routes_output_is_caught_on_that_route_alone() {
    let library = Library::embedded().expect("the embedded library is whole");
    for (route, from, to) in PLANTED {
        let fault = Fault {
            route,
            from: from.to_owned(),
            to: to.to_owned(),
        };
        let selection = Selection {
            filter: Some("parallax_offset/hardened/random".to_owned()),
            fault: Some(fault),
            ..Selection::default()
        };
        let Some(report) = report("a fault in one route", &selection, &library) else {
            return;
        };
        let ran = report.cases.iter().any(|case| case.route == route);
        let refused = |case: &&CaseResult| case.verdict == Verdict::Fail && case.worst.is_some();
        let caught: BTreeSet<Route> = report
            .cases
            .iter()
            .filter(refused)
            .map(|case| case.route)
            .collect();
        let expected: BTreeSet<Route> = ran.then_some(route).into_iter().collect();
        assert_eq!(caught, expected, "{}", listed(&report, Verdict::Fail));
        let matrix = Matrix::of(&report);
        let failed =
            |(column, cell): &(&Column, &Cell)| (cell.verdict == Verdict::Fail).then_some(column.route);
        let cells = matrix
            .rows
            .iter()
            .flat_map(|row| matrix.columns.iter().zip(&row.cells));
        let named: BTreeSet<Route> = cells.filter_map(|cell| failed(&cell)).collect();
        assert_eq!(named, expected);
    }
}
