//! Kept shots in files, where later runs of this program find them.
//!
//! Every process appends only to its own files; it reads those that were in the folder when it began a
//! problem. A record is a shot's key and code with a checksum of them and of the problem; a damaged or incomplete
//! one counts as missing, and so does one from another problem's file. The checksum guards against accidents, not
//! against people who can write to the folder.
//! The name of a file is a digest of all that decides the shots: this program, the scene's files, mesh, cut and
//! hemisphere.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use serde_json::json;
use virtwall::{Archive, ShotKey};
use xxhash_rust::xxh3::{xxh3_64, xxh3_64_with_seed};

use crate::files::digest::sha256;
use crate::host::held::held;
use crate::host::program::program;
use crate::planning::plan::Prepared;

/// What a file begins with, before the digest of its problem.
const MAGIC: &str = "virtwall shots 2 ";

/// Bytes of a record before its code: the code's length and the checksum of key and code; the key.
const HEAD: usize = 4 + 8 + ShotKey::BYTES;

/// Characters of the digest that begin a file's name.
const NAMED_BY: usize = 32;

/// Files of one problem that are read.
const MOST_FILES: usize = 64;

/// A folder of kept shots.
pub struct ShotFiles {
    folder: PathBuf,
    /// Why shots are no longer written, if so.
    trouble: Arc<Mutex<Option<String>>>,
}

impl ShotFiles {
    /// Uses a folder, which is made if there is none.
    pub fn open(folder: &Path) -> io::Result<ShotFiles> {
        fs::create_dir_all(folder)?;
        fs::read_dir(folder)?;
        Ok(ShotFiles { folder: folder.to_owned(), trouble: Arc::default() })
    }

    /// Why shots were no longer written, if so.
    pub fn trouble(&self) -> Option<String> {
        held(&self.trouble).clone()
    }

    /// The shots of a problem, cast by this build of the program: another build may cast them differently.
    pub fn of(&self, prepared: &Prepared) -> Box<dyn Archive> {
        let scene: Vec<&str> = prepared.digests.iter().map(|file| file.sha256.as_str()).collect();
        let settings = &prepared.settings;
        let decides = json!({ "program": program(), "scene": scene, "settings": settings });
        let problem = sha256(decides.to_string().as_bytes());
        let mut shots = Shots::default();
        for path in self.paths(&problem) {
            // A file that cannot be read counts as missing.
            let _ = shots.read(&path, &problem);
        }
        let (folder, trouble) = (self.folder.clone(), Arc::clone(&self.trouble));
        Box::new(ShotFile { folder, problem, trouble, shots: Mutex::new(shots) })
    }

    /// The files of a problem, the largest first, limited to a number that can be open at a time.
    fn paths(&self, problem: &str) -> Vec<PathBuf> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let named = entries
            .filter(|entry| entry.file_name().to_string_lossy().starts_with(&problem[..NAMED_BY]));
        let sized = named.map(|entry| (entry.metadata().map_or(0, |of| of.len()), entry.path()));
        let mut files: Vec<(u64, PathBuf)> = sized.collect();
        files.sort_unstable_by(|one, other| other.cmp(one));
        files.into_iter().map(|(_, path)| path).take(MOST_FILES).collect()
    }
}

struct ShotFile {
    folder: PathBuf,
    /// What decides its shots, as a digest.
    problem: String,
    trouble: Arc<Mutex<Option<String>>>,
    shots: Mutex<Shots>,
}

#[derive(Default)]
struct Shots {
    files: Vec<File>,
    places: BTreeMap<ShotKey, Place>,
    /// The file that this process writes, and how long it is.
    own: Option<(usize, u64)>,
}

#[derive(Clone, Copy)]
struct Place {
    file: usize,
    offset: u64,
    length: u32,
}

impl Shots {
    fn read(&mut self, path: &Path, problem: &str) -> io::Result<()> {
        let mut from = BufReader::new(File::open(path)?);
        let end = from.get_ref().metadata()?.len();
        let mut header = String::new();
        from.by_ref().take(200).read_line(&mut header)?;
        if header.trim_end().strip_prefix(MAGIC) != Some(problem) {
            return Ok(());
        }
        let mut offset = header.len() as u64;
        let mut head = [0; HEAD];
        while from.read_exact(&mut head).is_ok() {
            let (length, _, key) = split(&head);
            let next = offset + HEAD as u64 + u64::from(length);
            if next > end {
                break;
            }
            self.places.insert(key, Place { file: self.files.len(), offset, length });
            from.seek_relative(i64::from(length))?;
            offset = next;
        }
        self.files.push(from.into_inner());
        Ok(())
    }

    /// The code at a place, if its checksum is right.
    fn code(&mut self, problem: &str, key: &ShotKey, place: Place) -> Option<Vec<u8>> {
        let file = &mut self.files[place.file];
        file.seek(SeekFrom::Start(place.offset)).ok()?;
        let mut record = vec![0; HEAD + place.length as usize];
        file.read_exact(&mut record).ok()?;
        let (length, checksum, found) = split(record.first_chunk()?);
        let right = (length, found) == (place.length, *key);
        let right = right && checksum == checksum_of(problem, &record[12..]);
        right.then(|| record.split_off(HEAD))
    }
}

impl ShotFile {
    fn append(&self, shots: &mut Shots, key: &ShotKey, code: &[u8]) -> io::Result<()> {
        let (file, offset) = match shots.own {
            Some(own) => own,
            None => {
                let (file, length) = self.create()?;
                shots.files.push(file);
                (shots.files.len() - 1, length)
            }
        };
        let length = code.len() as u32;
        let mut record = Vec::with_capacity(HEAD + code.len());
        record.extend(length.to_le_bytes());
        record.extend([0; 8]);
        record.extend(key.to_bytes());
        record.extend(code);
        let checksum = checksum_of(&self.problem, &record[12..]);
        record[4..12].copy_from_slice(&checksum.to_le_bytes());
        // In one piece, past every buffer of this program: if it is killed, what is written stays.
        shots.files[file].write_all(&record)?;
        shots.own = Some((file, offset + record.len() as u64));
        shots.places.insert(*key, Place { file, offset, length });
        Ok(())
    }

    /// A file that no other process writes, and how long it is.
    fn create(&self) -> io::Result<(File, u64)> {
        let header = format!("{MAGIC}{}\n", self.problem);
        let mut number = 0;
        loop {
            let (named, process) = (&self.problem[..NAMED_BY], std::process::id());
            let name = format!("{named}-{process}-{number}.shots");
            let path = self.folder.join(name);
            match OpenOptions::new().read(true).append(true).create_new(true).open(path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                opened => {
                    let mut file = opened?;
                    file.write_all(header.as_bytes())?;
                    return Ok((file, header.len() as u64));
                }
            }
        }
    }
}

impl Archive for ShotFile {
    fn find(&self, key: &ShotKey) -> Option<Vec<u8>> {
        let mut shots = held(&self.shots);
        let place = *shots.places.get(key)?;
        shots.code(&self.problem, key, place)
    }

    fn put(&self, key: &ShotKey, code: &[u8]) {
        let mut trouble = held(&self.trouble);
        if trouble.is_none()
            && let Err(error) = self.append(&mut held(&self.shots), key, code)
        {
            *trouble = Some(format!("{}: {error}", self.folder.display()));
        }
    }
}

/// The checksum of a record of a problem: of its key and its code.
fn checksum_of(problem: &str, record: &[u8]) -> u64 {
    xxh3_64_with_seed(record, xxh3_64(problem.as_bytes()))
}

/// The parts of a record's head: length of the code, checksum, key.
fn split(head: &[u8; HEAD]) -> (u32, u64, ShotKey) {
    let length = u32::from_le_bytes(std::array::from_fn(|i| head[i]));
    let checksum = u64::from_le_bytes(std::array::from_fn(|i| head[4 + i]));
    (length, checksum, ShotKey::from_bytes(&std::array::from_fn(|i| head[12 + i])))
}
