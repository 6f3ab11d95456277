//! Reading a file that may be anything: never waits, never without end.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Why a file is not read.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// The path leads to a folder.
    #[error("a folder")]
    Folder,
    /// A pipe or a device, which could make a reader wait and may act on being opened.
    #[error("a pipe or a device")]
    Special,
    /// What the system shows as a file and makes up as it is read, perhaps without end.
    #[error("a pseudo file of the system")]
    Pseudo,
    /// The file has more bytes than the caller takes.
    #[error("a file of more than {} MB", limit / 1024 / 1024)]
    Large {
        /// Most bytes that are taken.
        limit: u64,
    },
    /// What the system says: no such file, no permission, a broken disk.
    #[error("{0}")]
    System(#[from] std::io::Error),
}

/// Reads the file at `path`, if it has at most `limit` bytes.
///
/// Refused, without reading, is what is no file on a disk (folders, pipes, devices, files of /proc and the like) and
/// what is too large. Nothing is waited for.
pub fn read_bounded(path: &Path, limit: u64) -> Result<Vec<u8>, Unreadable> {
    // Before it is opened: to open some devices is to use them.
    check(&std::fs::metadata(path)?, limit)?;
    if is_pseudo(path) {
        return Err(Unreadable::Pseudo);
    }
    let file = open(path)?;
    // It may have become something else meanwhile.
    check(&file.metadata()?, limit)?;
    let mut bytes = Vec::new();
    // One byte past the limit is enough to know of a file that grows.
    match file.take(limit + 1).read_to_end(&mut bytes) {
        Ok(_) if bytes.len() as u64 > limit => Err(Unreadable::Large { limit }),
        Ok(_) => Ok(bytes),
        // A file on a disk never makes a reader wait.
        Err(error) if error.kind() == ErrorKind::WouldBlock => Err(Unreadable::Pseudo),
        Err(error) => Err(error.into()),
    }
}

fn check(about: &std::fs::Metadata, limit: u64) -> Result<(), Unreadable> {
    match about {
        _ if about.is_dir() => Err(Unreadable::Folder),
        _ if !about.is_file() => Err(Unreadable::Special),
        _ if about.len() > limit => Err(Unreadable::Large { limit }),
        _ => Ok(()),
    }
}

#[cfg(unix)]
fn open(path: &Path) -> std::io::Result<File> {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt;
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    File::options().read(true).custom_flags(flags.bits() as i32).open(path)
}

#[cfg(not(unix))]
fn open(path: &Path) -> std::io::Result<File> {
    File::open(path)
}

/// Whether a path leads to a file system that holds no files but shows the state of the system: proc, sysfs, debugfs,
/// tracefs, securityfs, configfs, both of cgroup, bpf, pstore, efivarfs, mqueue, selinuxfs, nsfs.
#[cfg(target_os = "linux")]
fn is_pseudo(path: &Path) -> bool {
    // From linux/magic.h.
    const MAGIC: [u64; 14] = [
        0x9fa0,
        0x6265_6572,
        0x6462_6720,
        0x7472_6163,
        0x7363_6673,
        0x6265_6570,
        0x0027_e0eb,
        0x6367_7270,
        0xcafe_4a11,
        0x6165_676c,
        0xde5e_81e4,
        0x1980_0202,
        0xf97c_ff8c,
        0x6e73_6673,
    ];
    // Kept in 32 bits by the system, whose type here is signed on some machines.
    rustix::fs::statfs(path).is_ok_and(|about| MAGIC.contains(&(about.f_type as u64 & 0xffff_ffff)))
}

#[cfg(not(target_os = "linux"))]
fn is_pseudo(_: &Path) -> bool {
    false
}

#[cfg(test)]
#[cfg(target_os = "linux")]
mod tests {
    use super::*;

    #[test]
    fn what_the_system_makes_up_is_refused_without_reading_it() {
        for path in ["/proc/version", "/proc/kmsg", "/proc/self/maps", "/proc/self/mem", "/sys/kernel/mm/hugepages"] {
            if !Path::new(path).exists() {
                continue;
            }
            let refused = read_bounded(Path::new(path), 1 << 24);
            assert!(matches!(refused, Err(Unreadable::Pseudo | Unreadable::Folder)), "{path}: {refused:?}");
        }
    }

    #[test]
    fn links_lead_to_what_they_name() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        std::os::unix::fs::symlink("/dev/zero", at("zero")).expect("a link");
        assert!(matches!(read_bounded(&at("zero"), 10), Err(Unreadable::Special)));
        std::os::unix::fs::symlink("/proc/self/status", at("status")).expect("a link");
        assert!(matches!(read_bounded(&at("status"), 10), Err(Unreadable::Pseudo)));
        std::fs::write(at("ten"), "0123456789").expect("a file");
        std::os::unix::fs::symlink("ten", at("to_ten")).expect("a link");
        assert_eq!(read_bounded(&at("to_ten"), 10).expect("ten bytes"), b"0123456789");
        assert!(matches!(read_bounded(&at("to_ten"), 9), Err(Unreadable::Large { limit: 9 })));
    }
}
