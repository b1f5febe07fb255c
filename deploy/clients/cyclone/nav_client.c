/* A flight computer's navigation app on Eclipse Cyclone DDS, with nothing of the simulator but its IDL (compiled by
 * idlc). It navigates by GNSS alone: the newest fix, carried on by its velocity to the time of the newest IMU sample,
 * and publishes one NavSolution for each IMU sample. A real app would put its mechanization and filter where
 * solve() is.
 *
 *   cyclone_nav_client [--domain N] [--unit NAME] [--seconds S] [--values FILE]
 *
 * Ends after S seconds (default 60), or when the run that it has heard of has ended. Prints what came; --values writes
 * every sample's sequence number and first values as hexadecimal floating point, for comparison with the log.
 * Exit code 1 when a sequence number was missing or nothing came.
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
static void solve(const inslab_v1_GnssFix* fix, const inslab_v1_ImuSample* imu, inslab_v1_NavSolution* nav) {
  const double age_s = (double)(imu->header.gps_time_of_week_ns - fix->header.gps_time_of_week_ns) * 1e-9;
  memset(nav, 0, sizeof(*nav));
  nav->gps_week = imu->header.gps_week;
  nav->gps_time_of_week_ns = imu->header.gps_time_of_week_ns;
  nav->imu_sequence = imu->header.sequence_number;
  nav->reference_point = inslab_v1_REFERENCE_ANTENNA;
  nav->mode = inslab_v1_NAV_MODE_NAVIGATING;
  nav->latitude_rad = fix->latitude_rad + fix->v_n_m_per_s[0] * age_s / kSemiMajorAxis_m;
  nav->longitude_rad = fix->longitude_rad + fix->v_n_m_per_s[1] * age_s / (kSemiMajorAxis_m * cos(fix->latitude_rad));
  nav->height_m = fix->height_m - fix->v_n_m_per_s[2] * age_s;
  memcpy(nav->v_n_m_per_s, fix->v_n_m_per_s, sizeof(nav->v_n_m_per_s));
  nav->q_n_body[0] = 1.0;
  memcpy(nav->position_sigma_ned_m, fix->position_sigma_ned_m, sizeof(nav->position_sigma_ned_m));
  memcpy(nav->velocity_sigma_ned_m_per_s, fix->velocity_sigma_ned_m_per_s, sizeof(nav->velocity_sigma_ned_m_per_s));
  for (int axis = 0; axis < 3; axis++) nav->attitude_sigma_rad[axis] = 3.2; /* GNSS alone knows no attitude */
}

int main(int argc, char** argv) {
  uint32_t domain = 0;
  const char* unit = NULL;
  const char* values_path = NULL;
  double seconds = 60.0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (strcmp(argv[i], "--domain") == 0) {
      domain = (uint32_t)atoi(argv[i + 1]);
    } else if (strcmp(argv[i], "--unit") == 0) {
      unit = argv[i + 1];
    } else if (strcmp(argv[i], "--seconds") == 0) {
      seconds = atof(argv[i + 1]);
    } else if (strcmp(argv[i], "--values") == 0) {
      values_path = argv[i + 1];
    } else {
      fprintf(stderr, "unknown option %s\n", argv[i]);
      return 2;
    }
  }
  FILE* values = values_path == NULL ? NULL : fopen(values_path, "w");
  if (values_path != NULL && values == NULL) {
    perror(values_path);
    return 2;
  }

  const dds_entity_t participant = checked(dds_create_participant(domain, NULL, NULL), "participant");
  dds_qos_t* group = dds_create_qos();
  if (unit != NULL) dds_qset_partition1(group, unit);
  const dds_entity_t subscriber = checked(dds_create_subscriber(participant, group, NULL), "subscriber");
  const dds_entity_t publisher = checked(dds_create_publisher(participant, group, NULL), "publisher");
  dds_qos_t* qos = stream_qos(1000);
  struct stream truth = {"inslab/truth", 0, 0, 0, 0};
  struct stream imu = {"inslab/imu/0", 0, 0, 0, 0};
  struct stream gnss = {"inslab/gnss/0", 0, 0, 0, 0};
  truth.reader = reader_of(participant, subscriber, &inslab_v1_TruthState_desc, truth.name, qos);
  imu.reader = reader_of(participant, subscriber, &inslab_v1_ImuSample_desc, imu.name, qos);
  gnss.reader = reader_of(participant, subscriber, &inslab_v1_GnssFix_desc, gnss.name, qos);
  dds_qos_t* latched = stream_qos(1);
  dds_qset_durability(latched, DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t status = reader_of(participant, subscriber, &inslab_v1_SimStatus_desc, "inslab/sim/status", latched);
  const dds_entity_t nav_topic =
      checked(dds_create_topic(participant, &inslab_v1_NavSolution_desc, "inslab/nav", NULL, NULL), "inslab/nav");
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
  inslab_v1_GnssFix fix = {0};
  bool have_fix = false;
  uint64_t published = 0;
  uint64_t truth_sent = 0;
  bool ended = false;
  dds_time_t deadline = dds_time() + (dds_duration_t)(seconds * 1e9);
  bool closing = false;
  while (dds_time() < deadline) {
    if (ended && truth.next >= truth_sent && !closing) {
      closing = true; /* what is still on its way on the other topics has this long to come */
      const dds_time_t soon = dds_time() + DDS_MSECS(500);
      deadline = soon < deadline ? soon : deadline;
    }
    dds_waitset_wait(waitset, NULL, 0, DDS_MSECS(100));
    memset(samples, 0, sizeof(samples));
    int32_t n = dds_take(gnss.reader, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      if (!infos[i].valid_data) continue;
      fix = *(const inslab_v1_GnssFix*)samples[i];
      have_fix = fix.fix_type != inslab_v1_FIX_NONE;
      count(&gnss, fix.header.sequence_number);
      if (values) fprintf(values, "gnss %" PRIu64 " %a %a\n", fix.header.sequence_number, fix.latitude_rad, fix.height_m);
    }
    if (n > 0) dds_return_loan(gnss.reader, samples, n);

    memset(samples, 0, sizeof(samples));
    n = dds_take(imu.reader, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      if (!infos[i].valid_data) continue;
      const inslab_v1_ImuSample* sample = samples[i];
      count(&imu, sample->header.sequence_number);
      if (values) {
        fprintf(values, "imu %" PRIu64 " %a %a\n", sample->header.sequence_number, sample->dtheta_b_rad[0],
                sample->dv_b_m_per_s[2]);
      }
      inslab_v1_NavSolution nav;
      if (have_fix) {
        solve(&fix, sample, &nav);
      } else {
        memset(&nav, 0, sizeof(nav));
        nav.gps_week = sample->header.gps_week;
        nav.gps_time_of_week_ns = sample->header.gps_time_of_week_ns;
        nav.imu_sequence = sample->header.sequence_number;
        nav.mode = inslab_v1_NAV_MODE_INITIALIZING;
        nav.q_n_body[0] = 1.0;
      }
      if (dds_write(nav_writer, &nav) == DDS_RETCODE_OK) published++;
    }
    if (n > 0) dds_return_loan(imu.reader, samples, n);

    memset(samples, 0, sizeof(samples));
    n = dds_take(truth.reader, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      if (!infos[i].valid_data) continue;
      const inslab_v1_TruthState* sample = samples[i];
      count(&truth, sample->header.sequence_number);
      if (values) {
        fprintf(values, "truth %" PRIu64 " %a %a\n", sample->header.sequence_number, sample->latitude_rad,
                sample->dv_v_m_per_s[2]);
      }
    }
    if (n > 0) dds_return_loan(truth.reader, samples, n);

    memset(samples, 0, sizeof(samples));
    n = dds_take(status, samples, infos, kBatch, kBatch);
    for (int32_t i = 0; i < n; i++) {
      const inslab_v1_SimStatus* sample = samples[i];
      if (!infos[i].valid_data || sample->state < inslab_v1_RUN_FINISHED) continue;
      ended = true;
      truth_sent = sample->truth_samples;
    }
    if (n > 0) dds_return_loan(status, samples, n);
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
