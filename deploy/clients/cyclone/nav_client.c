/* A flight computer's navigation app on Eclipse Cyclone DDS, with nothing of the simulator but its IDL (compiled by
 * idlc). It navigates by GNSS alone: the newest fix, carried on by its velocity to the time of the newest IMU sample,
 * and publishes one NavSolution for each IMU sample. A real app would put its mechanization and filter where
 * solve() is.
 *
 *   cyclone_nav_client [--domain N] [--unit NAME] [--seconds S] [--values FILE]
 *
 * Ends with the run, whose end its status tells or the trajectory server's going; with --seconds after S seconds at
 * the latest. Prints what came; --values writes every sample's sequence number and first values as hexadecimal floating
 * point, for comparison with the log. Exit code 1 when a sequence number was missing or nothing came.
 */
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "control.h"
#include "dds/dds.h"
#include "gnss.h"
#include "imu.h"
#include "nav.h"
#include "truth.h"

enum { kBatch = 64 };
static const double kSemiMajorAxis_m = 6378137.0; /* WGS-84; a sphere is near enough to carry a fix on for a second */

struct stream {
  const char* name;
  dds_entity_t reader;
  uint64_t received;
  uint64_t next;
  uint64_t missing;
};

static void fail(const char* what, dds_return_t code) {
  fprintf(stderr, "%s: %s\n", what, dds_strretcode(-code));
  exit(2);
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity < 0) fail(what, entity);
  return entity;
}

/* Reliable and volatile, keeping the last `depth` samples: the README's table. */
static dds_qos_t* stream_qos(int32_t depth) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

static dds_entity_t reader_of(dds_entity_t participant, dds_entity_t subscriber, const dds_topic_descriptor_t* type,
                              const char* topic, dds_qos_t* qos) {
  const dds_entity_t dds_topic = checked(dds_create_topic(participant, type, topic, NULL, NULL), topic);
  return checked(dds_create_reader(subscriber, dds_topic, qos, NULL), topic);
}

static void count(struct stream* stream, uint64_t sequence) {
  stream->received++;
  if (sequence >= stream->next) {
    stream->missing += sequence - stream->next;
    stream->next = sequence + 1;
  } else if (stream->missing > 0) {
    stream->missing--;
  }
}

/* The newest fix, carried on to `time_of_week_ns`. */
static void solve(const inslab_v5_GnssFix* fix, const inslab_v5_ImuSample* imu, inslab_v5_NavSolution* nav) {
  const double age_s = (double)(imu->header.gps_time_of_week_ns - fix->header.gps_time_of_week_ns) * 1e-9;
  memset(nav, 0, sizeof(*nav));
  nav->gps_week = imu->header.gps_week;
  nav->gps_time_of_week_ns = imu->header.gps_time_of_week_ns;
  nav->imu_sequence = imu->header.sequence_number;
  nav->reference_point = inslab_v5_REFERENCE_ANTENNA;
  nav->mode = inslab_v5_NAV_MODE_NAVIGATING;
  nav->latitude_rad = fix->latitude_rad + fix->v_n_m_per_s[0] * age_s / kSemiMajorAxis_m;
  nav->longitude_rad = fix->longitude_rad + fix->v_n_m_per_s[1] * age_s / (kSemiMajorAxis_m * cos(fix->latitude_rad));
  nav->height_m = fix->height_m - fix->v_n_m_per_s[2] * age_s;
  memcpy(nav->v_n_m_per_s, fix->v_n_m_per_s, sizeof(nav->v_n_m_per_s));
  nav->q_n_body[0] = 1.0;
  memcpy(nav->position_sigma_ned_m, fix->position_sigma_ned_m, sizeof(nav->position_sigma_ned_m));
  memcpy(nav->velocity_sigma_ned_m_per_s, fix->velocity_sigma_ned_m_per_s, sizeof(nav->velocity_sigma_ned_m_per_s));
  for (int axis = 0; axis < 3; axis++) nav->attitude_sigma_rad[axis] = 3.2; /* GNSS alone knows no attitude */
}

static const char kHelp[] =
    "A navigation app on Eclipse Cyclone DDS that navigates by GNSS alone; ends with the run.\n"
    "Usage: cyclone_nav_client [OPTIONS]\n\n"
    "  --domain N      DDS domain (default 0)\n"
    "  --unit NAME     the unit: the DDS partition (default none)\n"
    "  --seconds S     end after S seconds, should the run go on longer (default: with the run)\n"
    "  --values FILE   write what comes, for comparison with the log\n"
    "  -h, --help      print this\n";

struct options {
  uint32_t domain;
  const char* unit;
  const char* values;
  double seconds; /* 0: with the run */
};

static struct options parse(int argc, char** argv) {
  struct options options = {0, NULL, NULL, 0.0};
  for (int i = 1; i < argc; i += 2) {
    const char* name = argv[i];
    const char* value = i + 1 < argc ? argv[i + 1] : NULL;
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
      fputs(kHelp, stdout);
      exit(0);
    } else if (value != NULL && strcmp(name, "--domain") == 0) {
      options.domain = (uint32_t)atoi(value);
    } else if (value != NULL && strcmp(name, "--unit") == 0) {
      options.unit = value;
    } else if (value != NULL && strcmp(name, "--seconds") == 0) {
      options.seconds = atof(value);
    } else if (value != NULL && strcmp(name, "--values") == 0) {
      options.values = value;
    } else {
      fprintf(stderr, "cyclone_nav_client: unknown option, or no value after it: %s; --help lists them\n", name);
      exit(2);
    }
  }
  return options;
}

/* When to end: with the run. */
struct run_follower {
  struct options options;
  dds_entity_t status;
  dds_time_t begun;
  dds_time_t ended; /* 0: not yet */
  dds_time_t came;  /* when a sample came last */
  uint64_t received;
  uint64_t truth_sent;
  uint64_t truth_at_end; /* as the newest status says */
  bool end_heard;        /* the newest status is of a run's end */
  bool running;
  bool told;
};

static void end_with(struct run_follower* run, uint64_t truth_samples) {
  run->truth_sent = truth_samples;
  run->ended = dds_time();
}

/* Takes what has come of the run's status. `next_truth` follows the newest truth sample that has come, `received` counts
 * the samples of all streams. */
static bool is_over(struct run_follower* run, uint64_t next_truth, uint64_t received) {
  void* samples[1] = {NULL};
  dds_sample_info_t info;
  while (dds_take(run->status, samples, &info, 1, 1) > 0) {
    const inslab_v5_SimStatus* status = samples[0];
    if (info.valid_data) {
      const bool ended = status->state >= inslab_v5_RUN_FINISHED;
      run->running = run->running || !ended;
      run->end_heard = ended;
      run->truth_at_end = status->truth_samples;
    }
    dds_return_loan(run->status, samples, 1);
    samples[0] = NULL;
  }
  /* The end of a run that was over before this app came is not the end that it waits for. A short run may be over before
   * its status was read; its samples tell that it was there. */
  run->running = run->running || received > 0;
  if (run->end_heard && run->running && run->ended == 0) end_with(run, run->truth_at_end);
  dds_subscription_matched_status_t matched = {0};
  dds_get_subscription_matched_status(run->status, &matched);
  if (run->running && run->ended == 0 && matched.current_count == 0) end_with(run, 0); /* the server was killed */
  const dds_time_t now = dds_time();
  if (received != run->received) run->came = now;
  run->received = received;
  if (!run->running && !run->told && now - run->begun > DDS_SECS(2)) {
    run->told = true;
    fprintf(stderr, "waits for a run on domain %u%s%s\n", (unsigned)run->options.domain,
            run->options.unit == NULL ? "" : ", unit ", run->options.unit == NULL ? "" : run->options.unit);
  }
  if (run->options.seconds > 0.0 && (double)(now - run->begun) * 1e-9 > run->options.seconds) return true;
  /* What is still on its way has this long to come after what came last, and more when it is known that it must. */
  const dds_time_t last = run->came > run->ended ? run->came : run->ended;
  return run->ended != 0 && now - last > (next_truth >= run->truth_sent ? DDS_MSECS(500) : DDS_SECS(3));
}

int main(int argc, char** argv) {
  const struct options options = parse(argc, argv);
  const char* values_path = options.values;
  FILE* values = values_path == NULL ? NULL : fopen(values_path, "w");
  if (values_path != NULL && values == NULL) {
    perror(values_path);
    return 2;
  }

  const dds_entity_t participant = checked(dds_create_participant(options.domain, NULL, NULL), "participant");
  dds_qos_t* group = dds_create_qos();
  if (options.unit != NULL) dds_qset_partition1(group, options.unit);
  const dds_entity_t subscriber = checked(dds_create_subscriber(participant, group, NULL), "subscriber");
  const dds_entity_t publisher = checked(dds_create_publisher(participant, group, NULL), "publisher");
  dds_qos_t* qos = stream_qos(1000);
  struct stream truth = {"inslab/truth", 0, 0, 0, 0};
  struct stream imu = {"inslab/imu/0", 0, 0, 0, 0};
  struct stream gnss = {"inslab/gnss/0", 0, 0, 0, 0};
  truth.reader = reader_of(participant, subscriber, &inslab_v5_TruthState_desc, truth.name, qos);
  imu.reader = reader_of(participant, subscriber, &inslab_v5_ImuSample_desc, imu.name, qos);
  gnss.reader = reader_of(participant, subscriber, &inslab_v5_GnssFix_desc, gnss.name, qos);
  dds_qos_t* latched = stream_qos(1);
  dds_qset_durability(latched, DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t status = reader_of(participant, subscriber, &inslab_v5_SimStatus_desc, "inslab/sim/status", latched);
  const dds_entity_t nav_topic =
      checked(dds_create_topic(participant, &inslab_v5_NavSolution_desc, "inslab/nav", NULL, NULL), "inslab/nav");
  const dds_entity_t nav_writer = checked(dds_create_writer(publisher, nav_topic, qos, NULL), "inslab/nav");

  const dds_entity_t waitset = checked(dds_create_waitset(participant), "waitset");
  const dds_entity_t inputs[] = {truth.reader, imu.reader, gnss.reader, status};
  for (size_t i = 0; i < sizeof(inputs) / sizeof(inputs[0]); i++) {
    const dds_entity_t condition =
        checked(dds_create_readcondition(inputs[i], DDS_ANY_STATE), "read condition");
    dds_waitset_attach(waitset, condition, (dds_attach_t)i);
  }

  void* samples[kBatch];
  dds_sample_info_t infos[kBatch];
  inslab_v5_GnssFix fix = {0};
  bool have_fix = false;
  uint64_t published = 0;
  struct run_follower run = {.options = options, .status = status, .begun = dds_time()};
  while (!is_over(&run, truth.next, truth.received + imu.received + gnss.received)) {
    dds_waitset_wait(waitset, NULL, 0, DDS_MSECS(100));
    memset(samples, 0, sizeof(samples));
    int32_t n = dds_take(gnss.reader, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      if (!infos[i].valid_data) continue;
      fix = *(const inslab_v5_GnssFix*)samples[i];
      have_fix = fix.fix_type != inslab_v5_FIX_NONE;
      count(&gnss, fix.header.sequence_number);
      if (values) fprintf(values, "gnss %" PRIu64 " %a %a\n", fix.header.sequence_number, fix.latitude_rad, fix.height_m);
    }
    if (n > 0) dds_return_loan(gnss.reader, samples, n);

    memset(samples, 0, sizeof(samples));
    n = dds_take(imu.reader, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      if (!infos[i].valid_data) continue;
      const inslab_v5_ImuSample* sample = samples[i];
      count(&imu, sample->header.sequence_number);
      if (values) {
        fprintf(values, "imu %" PRIu64 " %a %a\n", sample->header.sequence_number, sample->dtheta_b_rad[0],
                sample->dv_b_m_per_s[2]);
      }
      inslab_v5_NavSolution nav;
      if (have_fix) {
        solve(&fix, sample, &nav);
      } else {
        memset(&nav, 0, sizeof(nav));
        nav.gps_week = sample->header.gps_week;
        nav.gps_time_of_week_ns = sample->header.gps_time_of_week_ns;
        nav.imu_sequence = sample->header.sequence_number;
        nav.mode = inslab_v5_NAV_MODE_INITIALIZING;
        nav.q_n_body[0] = 1.0;
      }
      if (dds_write(nav_writer, &nav) == DDS_RETCODE_OK) published++;
    }
    if (n > 0) dds_return_loan(imu.reader, samples, n);

    memset(samples, 0, sizeof(samples));
    n = dds_take(truth.reader, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      if (!infos[i].valid_data) continue;
      const inslab_v5_TruthState* sample = samples[i];
      count(&truth, sample->header.sequence_number);
      if (values) {
        fprintf(values, "truth %" PRIu64 " %a %a\n", sample->header.sequence_number, sample->latitude_rad,
                sample->dv_v_m_per_s[2]);
      }
    }
    if (n > 0) dds_return_loan(truth.reader, samples, n);
  }
  dds_wait_for_acks(nav_writer, DDS_SECS(2));
  if (values) fclose(values);
  const struct stream* streams[] = {&truth, &imu, &gnss};
  bool whole = true;
  for (size_t i = 0; i < 3; i++) {
    printf("%s: %" PRIu64 " samples, %" PRIu64 " missing\n", streams[i]->name, streams[i]->received, streams[i]->missing);
    whole = whole && streams[i]->received > 0 && streams[i]->missing == 0;
  }
  printf("inslab/nav: %" PRIu64 " solutions published\n", published);
  dds_delete(participant);
  return whole ? 0 : 1;
}
