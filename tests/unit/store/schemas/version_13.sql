-- A database as version 13 of the schema made and filled it.
BEGIN TRANSACTION;
CREATE TABLE artefacts(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, name TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes INTEGER NOT NULL, content_type TEXT NOT NULL, of_package INTEGER NOT NULL,
  PRIMARY KEY(model, name)) STRICT, WITHOUT ROWID;
INSERT INTO "artefacts" VALUES('face','mesh.drc','eeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeee',10,'application/octet-stream',1);
INSERT INTO "artefacts" VALUES('face','positions','cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc',10,'application/octet-stream',0);
INSERT INTO "artefacts" VALUES('face','preview.glb','dddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddddd',10,'application/octet-stream',0);
INSERT INTO "artefacts" VALUES('face','source','aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',10,'application/octet-stream',0);
INSERT INTO "artefacts" VALUES('face','weights','ffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffffff',10,'application/octet-stream',1);
INSERT INTO "artefacts" VALUES('new','source','bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb',11,'application/octet-stream',0);
CREATE TABLE displacement_sets(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, kind TEXT NOT NULL, revision INTEGER NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, displacements TEXT NOT NULL, source TEXT NOT NULL, owner TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "displacement_sets" VALUES(1,'smile','Smile','expression',1,'2025-01-02T03:04:05Z','2025-01-02T03:04:05Z','{"3.1":[1,2,3]}','','abcdefgh2345');
CREATE TABLE feature_points(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, position INTEGER NOT NULL, id TEXT NOT NULL,
  vertex INTEGER, x REAL, y REAL, z REAL, proposal TEXT, PRIMARY KEY(model, id)) STRICT, WITHOUT ROWID;
INSERT INTO "feature_points" VALUES('face',0,'2.1',5,NULL,NULL,NULL,NULL);
INSERT INTO "feature_points" VALUES('face',1,'3.5',NULL,0.5,1.5,0.25,'{"method":"shape","confidence":"low","expected_error":0.5}');
CREATE TABLE idempotency(
  key TEXT PRIMARY KEY, fingerprint TEXT NOT NULL, resource TEXT NOT NULL, created TEXT NOT NULL) STRICT;
INSERT INTO "idempotency" VALUES('k','f','job-i','2025-01-02T03:04:05Z');
CREATE TABLE identity(id TEXT NOT NULL, starts INTEGER NOT NULL) STRICT;
INSERT INTO "identity" VALUES('00000000000000000000000000000000',3);
CREATE TABLE job_files(
  job TEXT NOT NULL REFERENCES jobs(id) ON DELETE CASCADE, sha256 TEXT NOT NULL,
  PRIMARY KEY(job, sha256)) STRICT, WITHOUT ROWID;
INSERT INTO "job_files" VALUES('job-e','9999999999999999999999999999999999999999999999999999999999999999');
CREATE TABLE "jobs"(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, model TEXT REFERENCES models(id) ON DELETE CASCADE,
  state INTEGER NOT NULL, progress REAL NOT NULL, stage TEXT NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, problem TEXT NOT NULL,
  attempts INTEGER NOT NULL,
  result TEXT NOT NULL, request TEXT NOT NULL DEFAULT '{}', kind TEXT NOT NULL DEFAULT '', owner TEXT NOT NULL DEFAULT '', request_id TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "jobs" VALUES(1,'job-i','face',2,1.0,'done','2025-01-02T03:04:05Z','2025-01-02T03:04:05Z','',1,'','{}','import','abcdefgh2345','');
INSERT INTO "jobs" VALUES(2,'job-p','face',2,1.0,'done','2025-01-02T03:04:05Z','2025-01-02T03:04:05Z','',1,'','{"metric":"edge","weights":"smooth","weight_bits":12,"lods":[5000]}','parametrize','abcdefgh2345','r1');
INSERT INTO "jobs" VALUES(3,'job-n','new',0,0.0,'','2025-01-02T03:04:05Z','2025-01-02T03:04:05Z','',1,'','{}','import','abcdefgh2345','');
INSERT INTO "jobs" VALUES(4,'job-e','face',0,0.0,'','2025-01-02T03:04:05Z','2025-01-02T03:04:05Z','',1,'','{"name":"smile","expression_sha256":"9999999999999999999999999999999999999999999999999999999999999999"}','extract','abcdefgh2345','');
CREATE TABLE models(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, state INTEGER NOT NULL, problem TEXT NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, revision INTEGER NOT NULL,
  file_name TEXT NOT NULL, format TEXT NOT NULL, source_bytes INTEGER NOT NULL, source_sha256 TEXT NOT NULL,
  vertices INTEGER NOT NULL, triangles INTEGER NOT NULL, facts TEXT NOT NULL,
  points_revision INTEGER NOT NULL, owner TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "models" VALUES(1,'face','Ana',2,'','2025-01-02T03:04:05Z','2025-01-02T03:04:05Z',5,'ana.obj','obj',10,'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',8,4,'{"min":[0,0,0],"max":[1,2,3],"warnings":["a hole"],"parts":[{"name":"face","role":"skin","by_user":true,"vertices":8,"triangles":4,"min":[0,0,0],"max":[1,1,1]},{"name":"eye","role":"left_eye","by_user":false,"vertices":4,"triangles":2,"min":[0,0,0],"max":[1,1,1]}]}',2,'abcdefgh2345');
INSERT INTO "models" VALUES(2,'new','Importing',0,'','2025-01-02T03:04:05Z','2025-01-02T03:04:05Z',1,'b.obj','',11,'bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb',0,0,'{}',0,'abcdefgh2345');
CREATE TABLE packages(
  model TEXT PRIMARY KEY REFERENCES models(id) ON DELETE CASCADE,
  parametrization TEXT NOT NULL, created TEXT NOT NULL, metric TEXT NOT NULL, weights TEXT NOT NULL,
  weight_bits INTEGER NOT NULL, levels TEXT NOT NULL DEFAULT '[]') STRICT;
INSERT INTO "packages" VALUES('face','job-p','2025-01-02T03:04:05Z','edge','smooth',12,'[{"vertices":8,"triangles":4}]');
CREATE TABLE recordings(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, stream TEXT NOT NULL, name TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL,
  state INTEGER NOT NULL, ended TEXT NOT NULL, duration INTEGER NOT NULL, frames INTEGER NOT NULL,
  lost INTEGER NOT NULL, bytes INTEGER NOT NULL, epoch INTEGER NOT NULL, media_time INTEGER NOT NULL,
  max_duration INTEGER, owner TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "recordings" VALUES(1,'aaaaaaaaaaaa','talk','Take','face','2025-01-02T03:04:05Z',1,'stopped',1000,25,0,300,1,5,NULL,'abcdefgh2345');
CREATE TABLE speech_files(
  speech TEXT NOT NULL REFERENCES speeches(id) ON DELETE CASCADE, name TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes INTEGER NOT NULL, content_type TEXT NOT NULL, PRIMARY KEY(speech, name)) STRICT, WITHOUT ROWID;
CREATE TABLE speeches(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, created TEXT NOT NULL, request TEXT NOT NULL, text TEXT NOT NULL, voice TEXT NOT NULL,
  duration INTEGER NOT NULL, warnings TEXT NOT NULL, owner TEXT NOT NULL) STRICT;
INSERT INTO "speeches" VALUES(1,'ssssssssssss','2026-03-01T10:00:00.000Z','{"text":"Hi.","language":"en"}','Hi.','beeps',820,'[]','abcdefgh2345');
CREATE TABLE streams(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, title TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL, viseme_share REAL, batch_interval INTEGER NOT NULL DEFAULT 100, quantizer_scale REAL NOT NULL DEFAULT 1, is_public INTEGER NOT NULL DEFAULT 0, owner TEXT NOT NULL DEFAULT '') STRICT;
INSERT INTO "streams" VALUES(1,'talk','Talk','face','2025-01-02T03:04:05Z',0.25,40,0.5,1,'abcdefgh2345');
CREATE TABLE tokens(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, scope TEXT NOT NULL, stream TEXT NOT NULL, model TEXT NOT NULL,
  created TEXT NOT NULL, expires INTEGER, secret_hash TEXT NOT NULL) STRICT;
INSERT INTO "tokens" VALUES(1,'abcdefgh2345','Phone','edit','','','2025-01-02T03:04:05Z',NULL,'scrypt$1024$8$1$00$00');
CREATE TABLE worn_sets(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, slot TEXT NOT NULL,
  displacement_set TEXT NOT NULL, name TEXT NOT NULL, revision INTEGER NOT NULL, displacements TEXT NOT NULL,
  PRIMARY KEY(model, slot)) STRICT, WITHOUT ROWID;
INSERT INTO "worn_sets" VALUES('face','joy','smile','Smile',1,'{"3.1":[1,2,3]}');
CREATE INDEX artefacts_by_hash ON artefacts(sha256);
CREATE INDEX job_files_by_hash ON job_files(sha256);
CREATE INDEX recordings_by_stream ON recordings(stream);
CREATE INDEX jobs_by_model ON jobs(model, kind);
CREATE INDEX models_by_owner ON models(owner);
CREATE INDEX displacement_sets_by_owner ON displacement_sets(owner);
CREATE INDEX streams_by_owner ON streams(owner);
CREATE INDEX recordings_by_owner ON recordings(owner);
CREATE INDEX unfinished_jobs_by_owner ON jobs(owner) WHERE state IN (0, 1);
CREATE INDEX speeches_by_owner ON speeches(owner);
CREATE INDEX speech_files_by_hash ON speech_files(sha256);
DELETE FROM "sqlite_sequence";
INSERT INTO "sqlite_sequence" VALUES('jobs',4);
INSERT INTO "sqlite_sequence" VALUES('models',2);
INSERT INTO "sqlite_sequence" VALUES('displacement_sets',1);
INSERT INTO "sqlite_sequence" VALUES('streams',1);
INSERT INTO "sqlite_sequence" VALUES('recordings',1);
INSERT INTO "sqlite_sequence" VALUES('tokens',1);
INSERT INTO "sqlite_sequence" VALUES('speeches',1);
COMMIT;
PRAGMA user_version=13;
