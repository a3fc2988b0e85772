//! The C++ that calls an entry point with what a job gives it: written from its signature, compiled with its text.

use std::fmt::Write;

use bossage_translate::Stage;

use crate::signature::{Declared, Role, Signature};

/// The caller's text.
pub(crate) fn text(
    signature: &Signature,
    workgroup: [u32; 3],
    components: impl Fn(&Declared, bool) -> usize,
) -> String {
    let own = &signature.name;
    let mut text = String::from("#include \"shader.metal\"\n#include \"caller.h\"\n");
    let stage = match signature.stage {
        Stage::Compute => "msl_host_compute",
        Stage::Vertex => "msl_host_vertex",
        Stage::Fragment => "msl_host_fragment",
    };
    let total = |list: Vec<&Declared>, gives: bool| list.iter().map(|d| components(d, gives)).sum::<usize>();
    let (words_in, words_out) = (
        total(signature.values_in().collect(), false),
        total(signature.members_out.iter().collect(), true),
    );
    let [x, y, z] = workgroup;
    let waits = signature.waits;
    let mut line = |indent: usize, code: String| {
        let _ = writeln!(text, "{}{code}", "  ".repeat(indent));
    };
    line(
        0,
        format!(
            "const msl_host_entry msl_host_shader = {{{stage}, {words_in}, {words_out}, {{{x}, {y}, {z}}}, {waits}}};"
        ),
    );
    let ty = |index: usize| format!("msl_host::parameter<{index}, decltype(&{own})>");
    let of_role = |role: Role| {
        (0_usize..)
            .zip(&signature.parameters)
            .filter(move |(_, p)| p.role == role)
    };
    for (index, _) in of_role(Role::Workgroup) {
        line(0, format!("static {} msl_host_shared_{index};", ty(index)));
    }
    line(0, "void msl_host_begin_workgroup() {".to_owned());
    for (index, _) in of_role(Role::Workgroup) {
        // What a workgroup finds in its memory is anything.
        line(
            1,
            format!("__builtin_memset(&msl_host_shared_{index}, 0xa5, sizeof msl_host_shared_{index});"),
        );
    }
    line(0, "}".to_owned());
    line(0, "void msl_host_invoke(const msl_host_call* call) {".to_owned());
    line(1, "const unsigned* words = call->in;".to_owned());
    for (index, _) in of_role(Role::StageIn) {
        line(1, format!("{} a{index} = {{}};", ty(index)));
        for member in &signature.members_in {
            let (place, count) = (format!("a{index}.{}", member.name), components(member, false));
            line(
                1,
                format!("static_assert(msl::size<decltype({place})> == {count});"),
            );
            line(
                1,
                format!("{place} = msl_host::of_words<decltype({place})>(words);"),
            );
        }
    }
    let mut arguments = Vec::new();
    for (index, parameter) in (0_usize..).zip(&signature.parameters) {
        arguments.push(match parameter.role {
            Role::Buffer(slot) => format!("msl_host::buffer{{call->buffers[{slot}]}}"),
            Role::Texture(slot) => format!("msl_host::texture{{&call->textures[{slot}]}}"),
            Role::Sampler(slot) => format!("metal::sampler{{&call->samplers[{slot}]}}"),
            Role::Workgroup => format!("msl_host_shared_{index}"),
            Role::StageIn => format!("a{index}"),
            Role::GridPosition => ids(&ty(index), "call->grid"),
            Role::WorkgroupPosition => ids(&ty(index), "call->group"),
            Role::PositionInWorkgroup => ids(&ty(index), "call->local"),
            Role::IndexInWorkgroup => ids(&ty(index), "&call->index"),
            Role::Workgroups => ids(&ty(index), "call->groups"),
            Role::Location(_)
            | Role::Position
            | Role::VertexIndex
            | Role::InstanceIndex
            | Role::FrontFacing
            | Role::PrimitiveIndex
            | Role::SampleIndex
            | Role::SampleMask
            | Role::Depth => {
                let ty = ty(index);
                let count = components(parameter, false);
                line(1, format!("static_assert(msl::size<{ty}> == {count});"));
                line(1, format!("{ty} a{index} = msl_host::of_words<{ty}>(words);"));
                format!("a{index}")
            }
        });
    }
    let call = format!("{own}({})", arguments.join(", "));
    if signature.members_out.is_empty() {
        line(1, format!("{call};"));
    } else {
        line(1, format!("const auto result = {call};"));
        line(1, "unsigned* out = call->out;".to_owned());
        for member in &signature.members_out {
            let (name, count) = (&member.name, components(member, true));
            line(
                1,
                format!("static_assert(msl::size<decltype(result.{name})> == {count});"),
            );
            line(1, format!("msl_host::to_words(out, result.{name});"));
        }
    }
    line(0, "}".to_owned());
    text
}

fn ids(ty: &str, from: &str) -> String {
    format!("msl_host::of_ids<{ty}>({from})")
}
