//! Which adapters there are, and how one is chosen.
//!
//! The list is sorted by name, driver and driver version, so that it is the same in every run on a machine. Which
//! drivers are seen is up to the Vulkan loader and its environment (`VK_ADD_DRIVER_FILES`, `VK_DRIVER_FILES`).

use std::fmt;

use crate::error::Error;

/// What kind of device an adapter is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DeviceKind {
    /// A program on the CPU, such as lavapipe or SwiftShader.
    Cpu,
    /// A GPU that shares memory with the CPU.
    IntegratedGpu,
    /// A GPU with memory of its own.
    DiscreteGpu,
    /// A GPU seen through a virtual machine.
    VirtualGpu,
    /// Something else.
    Other,
}

impl DeviceKind {
    /// In reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cpu => "cpu",
            Self::IntegratedGpu => "integrated-gpu",
            Self::DiscreteGpu => "discrete-gpu",
            Self::VirtualGpu => "virtual-gpu",
            Self::Other => "other",
        }
    }
}

/// An adapter, with everything that a report has to say about where numbers come from.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AdapterInfo {
    /// The device's name, e.g. `llvmpipe (LLVM 15.0.6, 256 bits)`.
    pub name: String,
    /// The driver's name, e.g. `llvmpipe`.
    pub driver: String,
    /// The driver's version in its own words, e.g. `Mesa 22.3.6 (LLVM 15.0.6)`.
    pub driver_info: String,
    /// What kind of device it is.
    pub kind: DeviceKind,
    /// The API, e.g. `vulkan`.
    pub backend: String,
    /// The version of LLVM that makes the machine code, where name or driver version tells.
    pub llvm: Option<String>,
    /// The model of this machine's CPU; on a software driver it is part of what is measured.
    pub cpu: String,
}

impl fmt::Display for AdapterInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} [{}, {}]", self.name, self.kind.name(), self.driver_info)
    }
}

/// Which adapter is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub enum AdapterSelector {
    /// The first of the sorted list: real GPUs, then software, and SwiftShader last, which is the slowest and least exact.
    #[default]
    Any,
    /// The first whose name or driver holds this text, in any case. `lavapipe` also finds what calls itself `llvmpipe`.
    Named(String),
}

impl AdapterSelector {
    /// A selector of adapters whose name or driver holds `text`.
    #[must_use]
    pub fn named(text: &str) -> Self {
        Self::Named(text.to_owned())
    }

    /// Whether this selector takes that adapter.
    #[must_use]
    pub fn matches(&self, info: &AdapterInfo) -> bool {
        let Self::Named(text) = self else { return true };
        let wanted = text.to_lowercase();
        let described = format!("{} {} {}", info.name, info.driver, info.driver_info).to_lowercase();
        let is_lavapipe = info.backend == "vulkan" && described.contains("llvmpipe");
        described.contains(&wanted) || (is_lavapipe && "lavapipe".contains(&wanted))
    }
}

/// The Vulkan adapters of this machine, sorted. An empty list is no error here: [`crate::Device::open`] makes it one.
#[must_use]
pub fn adapters() -> Vec<AdapterInfo> {
    found().into_iter().map(|(info, _)| info).collect()
}

/// The adapter that the selector takes.
pub(crate) fn select(selector: &AdapterSelector) -> Result<(AdapterInfo, wgpu::Adapter), Error> {
    let all = found();
    if all.is_empty() {
        return Err(Error::NoAdapter);
    }
    let names = all.iter().map(|(info, _)| info.name.clone()).collect();
    let mut taken: Vec<_> = all
        .into_iter()
        .filter(|(info, _)| selector.matches(info))
        .collect();
    taken.sort_by_key(|(info, _)| rank(info));
    taken.into_iter().next().ok_or_else(|| match selector {
        AdapterSelector::Any => Error::NoAdapter,
        AdapterSelector::Named(wanted) => Error::NoSuchAdapter {
            wanted: wanted.clone(),
            found: names,
        },
    })
}

/// The order in which adapters are taken where none is named.
fn rank(info: &AdapterInfo) -> u8 {
    match info.kind {
        DeviceKind::Cpu if AdapterSelector::named("swiftshader").matches(info) => 2,
        DeviceKind::Cpu => 1,
        DeviceKind::IntegratedGpu | DeviceKind::DiscreteGpu | DeviceKind::VirtualGpu | DeviceKind::Other => 0,
    }
}

fn found() -> Vec<(AdapterInfo, wgpu::Adapter)> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    // No validation layers: wgpu's own validation is always on, and the layers are absent on most machines.
    descriptor.flags = wgpu::InstanceFlags::empty().with_env();
    let instance = wgpu::Instance::new(descriptor);
    let cpu = cpu_model();
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
    let described = adapters
        .into_iter()
        .map(|adapter| (describe(&adapter.get_info(), &cpu), adapter));
    let mut list: Vec<_> = described.collect();
    list.sort_by(|(a, _), (b, _)| a.cmp(b));
    list
}

fn describe(info: &wgpu::AdapterInfo, cpu: &str) -> AdapterInfo {
    AdapterInfo {
        name: info.name.clone(),
        driver: info.driver.clone(),
        driver_info: info.driver_info.clone(),
        kind: device_kind(info.device_type),
        backend: info.backend.to_str().to_owned(),
        llvm: llvm_version(&info.driver_info).or_else(|| llvm_version(&info.name)),
        cpu: cpu.to_owned(),
    }
}

fn device_kind(kind: wgpu::DeviceType) -> DeviceKind {
    match kind {
        wgpu::DeviceType::Cpu => DeviceKind::Cpu,
        wgpu::DeviceType::IntegratedGpu => DeviceKind::IntegratedGpu,
        wgpu::DeviceType::DiscreteGpu => DeviceKind::DiscreteGpu,
        wgpu::DeviceType::VirtualGpu => DeviceKind::VirtualGpu,
        wgpu::DeviceType::Other => DeviceKind::Other,
    }
}

/// The version after the word `LLVM`.
fn llvm_version(text: &str) -> Option<String> {
    let after = text.split("LLVM ").nth(1)?;
    let version: String = after
        .chars()
        .take_while(|c| c.is_ascii_digit() || *c == '.')
        .collect();
    (!version.is_empty()).then_some(version)
}

/// The CPU's model, from `/proc/cpuinfo`; where there is none, the architecture.
#[must_use]
pub fn cpu_model() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    model_name(&text).unwrap_or_else(|| std::env::consts::ARCH.to_owned())
}

fn model_name(cpuinfo: &str) -> Option<String> {
    let line = cpuinfo.lines().find(|line| line.starts_with("model name"))?;
    line.split_once(':').map(|(_, model)| model.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lavapipe() -> AdapterInfo {
        AdapterInfo {
            name: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
            driver: "llvmpipe".into(),
            driver_info: "Mesa 22.3.6 (LLVM 15.0.6)".into(),
            kind: DeviceKind::Cpu,
            backend: "vulkan".into(),
            llvm: Some("15.0.6".into()),
            cpu: "some".into(),
        }
    }

    #[test]
    fn selector_finds_lavapipe_by_either_name_in_any_case() {
        for text in ["lavapipe", "Lavapipe", "llvmpipe", "LLVMPIPE", "mesa"] {
            assert!(AdapterSelector::named(text).matches(&lavapipe()), "{text}");
        }
        assert!(AdapterSelector::Any.matches(&lavapipe()));
        assert!(!AdapterSelector::named("swiftshader").matches(&lavapipe()));
    }

    #[test]
    fn lavapipe_is_not_the_name_of_anything_else() {
        let other = AdapterInfo {
            name: "Radeon".into(),
            driver: "radv".into(),
            driver_info: "Mesa".into(),
            ..lavapipe()
        };
        assert!(!AdapterSelector::named("lavapipe").matches(&other));
    }

    #[test]
    fn where_none_is_named_a_gpu_goes_first_and_swiftshader_last() {
        let swiftshader = AdapterInfo {
            name: "SwiftShader Device (Subzero)".into(),
            driver: "SwiftShader driver".into(),
            driver_info: String::new(),
            ..lavapipe()
        };
        let gpu = AdapterInfo {
            name: "Z GPU".into(),
            kind: DeviceKind::DiscreteGpu,
            ..lavapipe()
        };
        assert_eq!([&swiftshader, &lavapipe(), &gpu].map(rank), [2, 1, 0]);
    }

    #[test]
    fn llvm_version_is_read_where_there_is_one() {
        assert_eq!(
            llvm_version("Mesa 22.3.6 (LLVM 15.0.6)").as_deref(),
            Some("15.0.6")
        );
        assert_eq!(llvm_version("Mesa 22.3.6"), None);
        assert_eq!(llvm_version("LLVM unknown"), None);
    }

    #[test]
    fn cpu_model_is_the_first_processors() {
        let text = "processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\nprocessor\t: 1\nmodel name\t: other\n";
        assert_eq!(model_name(text).as_deref(), Some("Some CPU @ 2 GHz"));
        assert_eq!(model_name("processor : 0\n"), None);
    }
}
